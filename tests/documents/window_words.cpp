#include "tests/documents/window_words.h"

#include <algorithm>
#include <regex>
#include <set>

#include "tests/documents/source_text.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

// Sources of the window; scripts and the record of a session stay English.
bool IsOfWindow(const std::string& file) {
  constexpr const char* kFolders[] = {"app/editor/",
                                      "app/files/",
                                      "app/panels/",
                                      "app/state/",
                                      "app/steps/",
                                      "app/platform/file_browser",
                                      "app/platform/picture_window"};
  constexpr const char* kOptions[] = {"authoring/depth/depth_options.h", "authoring/panorama/",
                                      "simulation/haptics/",
                                      "simulation/practice/session_options.h"};
  const auto starts = [&](const char* folder) { return file.starts_with(folder); };
  if (file.find("/script_record") != std::string::npos) return false;
  if (file.ends_with("file_browser_model_test.cpp")) return false;
  if (std::any_of(std::begin(kFolders), std::end(kFolders), starts)) return true;
  return file.ends_with(".h") && std::any_of(std::begin(kOptions), std::end(kOptions), starts) &&
         (file.ends_with("options.h") || file.starts_with("simulation/haptics/"));
}

// Escapes undone, and each value of a format as {}.
std::string Plain(const std::string& literal) {
  std::string text;
  for (std::size_t i = 0; i < literal.size(); ++i) {
    if (literal[i] != '\\' || i + 1 == literal.size()) {
      text += literal[i];
      continue;
    }
    ++i;
    text += literal[i] == 'n' ? ' ' : literal[i];
  }
  text = std::regex_replace(text, std::regex("\\{[^{}]*\\}"), "{}");
  text = text.substr(0, text.find("##"));
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

// A text for people: words with a blank or a capital, and no name of a file, key or function.
bool IsForPeople(const std::string& text) {
  static const std::regex two_letters("[A-Za-z\\x80-\\xff]{2}"), identifier("[a-z0-9_.+*/|=-]*"),
      call("gl[A-Z].*|GLFW.*|XDG.*|HOME|LANG.*|LC_.*"), unit("[{}%. 0-9a-z³°/×µ]{0,12}"),
      raw(".*%[a-z].*|arthroscene:.*|.*\\.(po|json|png|vtu)");
  // Identities of ImGui's windows, tables and lists.
  static const std::set<std::string> kHidden = {"file menu",    "start content", "overview mouse",
                                                "depth board",  "depth map",     "inset overview",
                                                "tear preview", "depth view",    "footage board",
                                                "Picture",      "Handle"};
  const std::string words = std::regex_replace(text, std::regex("\\{\\}"), "");
  return std::regex_search(words, two_letters) && !std::regex_match(text, identifier) &&
         !std::regex_match(text, call) && !std::regex_match(text, unit) &&
         !std::regex_match(text, raw) && !kHidden.contains(text);
}

// The English texts of a .po file, one string with line ends between them.
std::string EnglishOf(std::string_view table) {
  std::string all;
  for (std::size_t at = table.find("\nmsgid "); at != std::string_view::npos;
       at = table.find("\nmsgid ", at + 1)) {
    const std::size_t end = table.find("\nmsgstr ", at);
    std::string text;
    const std::string part(table.substr(at + 7, end - at - 7));
    static const std::regex quoted("\"((?:[^\"\\\\]|\\\\.)*)\"");
    for (std::sregex_iterator it(part.begin(), part.end(), quoted), none; it != none; ++it)
      text += (*it)[1].str();
    all += "\n" + Plain(text);
  }
  return all + "\n";
}

}  // namespace

std::vector<WindowWord> WindowWords(const fs::path& root) {
  std::vector<WindowWord> words;
  std::set<std::string> known;
  for (const fs::path& path : SourceFiles(root)) {
    const std::string file =
        path.is_absolute() ? path.lexically_relative(root).string() : path.string();
    if (!IsOfWindow(file)) continue;
    for (const Literal& literal : PartsOfSource(TextOf(root / file)).literals) {
      const std::string text = Plain(literal.text);
      if (IsForPeople(text) && known.insert(text).second)
        words.push_back({text, file + ":" + std::to_string(literal.number)});
    }
  }
  return words;
}

std::vector<WindowWord> WordsWithoutTranslation(const std::vector<WindowWord>& words,
                                                std::string_view table) {
  const std::string english = EnglishOf(table);
  std::vector<WindowWord> missing;
  for (const WindowWord& word : words)
    if (english.find(word.text) == std::string::npos) missing.push_back(word);
  return missing;
}

}  // namespace arthro::test
