// Words of the window in another language, found by the English text itself, so that panels know
// English only. The table is a .po file (resources/languages). An entry with {} stands for all
// texts that fmt::format makes of it: "Opened {}" gives "Geöffnet: {}" its file. {0:t} in a
// translation is the first value, itself translated. A text without an entry stays English.
// Pure: no window.
#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace arthro::app {

// One entry of a .po file.
struct PoEntry {
  std::string english, translated;
  int line = 0;  // line of its msgid, from 1
};
// Entries that are translated and not marked fuzzy; the file's own header is left out. Throws
// Error(kBadData) with the line.
std::vector<PoEntry> ParsePo(std::string_view text, const std::filesystem::path& file = {});

class Translation {
 public:
  Translation() = default;  // English
  explicit Translation(const std::vector<PoEntry>& entries);

  bool is_english() const { return exact_.empty() && patterns_.empty(); }
  // The text in this language, or itself. Blanks at either end are kept.
  const std::string& Of(const std::string& english);
  // Words of an item: what follows "##" is its identity and is no text.
  std::string Label(const std::string& name);

  // English texts that were asked for and have letters, but no entry.
  const std::set<std::string>& missing() const { return missing_; }

 private:
  // "a {} b {}" as {"a ", " b ", ""}.
  struct Pattern {
    std::vector<std::string> pieces;
    std::string translated;
    std::size_t letters = 0;  // letters of the pieces: the one with most letters fits first
  };
  bool Find(std::string_view english, std::string& translated);
  std::string Filled(const Pattern& pattern, const std::vector<std::string_view>& values);

  std::unordered_map<std::string, std::string> exact_, known_;
  std::vector<Pattern> patterns_;
  std::set<std::string> missing_;
};

// Sentence that lists the missing texts; "" where there are none. `names`: names of the data, one
// per line, which are the same in every language, as are units, numbers and file names.
std::string WordsOfMissing(const Translation& translation, const std::string& names);

}  // namespace arthro::app
