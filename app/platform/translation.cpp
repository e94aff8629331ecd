#include "app/platform/translation.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::app {
namespace {

constexpr std::size_t kMostKnown = 20000;  // texts that are remembered; numbers make new ones
constexpr std::size_t kLeastLetters = 2;   // letters of a pattern: "{} {}" would fit everything
constexpr std::size_t kMostMissing = 5000;

bool IsLetter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || static_cast<unsigned char>(c) >= 0x80;
}
std::size_t LettersIn(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), IsLetter));
}

// Text between quotes, with its escapes undone; nothing where a quote is missing.
std::optional<std::string> Unquoted(std::string_view line) {
  const std::size_t first = line.find('"'), last = line.rfind('"');
  if (first == std::string_view::npos || first == last) return std::nullopt;
  std::string text;
  for (std::size_t i = first + 1; i < last; ++i) {
    if (line[i] != '\\') {
      text += line[i];
    } else if (++i < last) {
      text += line[i] == 'n' ? '\n' : line[i] == 't' ? '\t' : line[i];
    }
  }
  return text;
}

// Parts of a text beside its {…}; a doubled brace stands for itself.
std::vector<std::string> PiecesOf(std::string_view text) {
  std::vector<std::string> pieces(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if ((text[i] == '{' || text[i] == '}') && i + 1 < text.size() && text[i + 1] == text[i]) {
      pieces.back() += text[i++];
    } else if (text[i] == '{') {
      i = std::min(text.find('}', i), text.size());
      pieces.emplace_back();
    } else {
      pieces.back() += text[i];
    }
  }
  return pieces;
}

// Values of the pieces' gaps; nothing where the text is not made of them.
std::optional<std::vector<std::string_view>> ValuesIn(std::string_view text,
                                                      const std::vector<std::string>& pieces) {
  if (!text.starts_with(pieces.front())) return std::nullopt;
  // "Move {}" is a name's; a sentence that begins so has an entry of its own.
  const bool is_open = pieces.back().empty();
  const bool tells = pieces[pieces.size() - 2].find(": ") != std::string::npos;
  if (is_open && !tells && text.ends_with('.')) return std::nullopt;
  std::vector<std::string_view> values;
  std::size_t at = pieces.front().size();
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const bool is_last = i + 1 == pieces.size();
    std::size_t end = 0;
    if (is_last) {
      if (text.size() < at + pieces[i].size() || !text.ends_with(pieces[i])) return std::nullopt;
      end = text.size() - pieces[i].size();
    } else {
      end = text.find(pieces[i], at);
      if (end == std::string_view::npos) return std::nullopt;
    }
    values.push_back(text.substr(at, end - at));
    at = end + pieces[i].size();
  }
  return values;
}

}  // namespace

std::vector<PoEntry> ParsePo(std::string_view text, const std::filesystem::path& file) {
  std::vector<PoEntry> entries;
  PoEntry entry;
  std::string* open = nullptr;  // the string that quoted lines lengthen
  bool is_fuzzy = false, next_is_fuzzy = false;
  int number = 0;
  const auto end_entry = [&] {
    if (!entry.english.empty() && !entry.translated.empty() && !is_fuzzy) entries.push_back(entry);
    entry = {};
    open = nullptr;
  };
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    ++number;
    const auto string_of = [&] {
      const auto unquoted = Unquoted(line);
      if (!unquoted)
        throw Error(Code::kBadData, fmt::format("line {}: a quote is missing", number), file);
      return *unquoted;
    };
    if (line.starts_with("#,") && line.find("fuzzy") != std::string_view::npos) {
      next_is_fuzzy = true;
    } else if (line.starts_with("msgid ")) {
      end_entry();
      is_fuzzy = std::exchange(next_is_fuzzy, false);
      entry.english = string_of();
      entry.line = number;
      open = &entry.english;
    } else if (line.starts_with("msgstr ")) {
      entry.translated = string_of();
      open = &entry.translated;
    } else if (line.starts_with('"')) {
      if (open == nullptr)
        throw Error(Code::kBadData, fmt::format("line {}: text without msgid", number), file);
      *open += string_of();
    } else if (!line.empty() && !line.starts_with('#') && line != "\r") {
      throw Error(Code::kBadData,
                  fmt::format("line {}: neither msgid nor msgstr; plural forms and contexts are "
                              "not used here",
                              number),
                  file);
    }
  }
  end_entry();
  return entries;
}

Translation::Translation(const std::vector<PoEntry>& entries) {
  for (const PoEntry& entry : entries) {
    Pattern pattern{PiecesOf(entry.english), entry.translated, 0};
    if (pattern.pieces.size() == 1) {
      exact_.emplace(pattern.pieces.front(), PiecesOf(entry.translated).front());
      continue;
    }
    for (const std::string& piece : pattern.pieces) pattern.letters += LettersIn(piece);
    if (pattern.letters >= kLeastLetters) patterns_.push_back(std::move(pattern));
  }
  std::stable_sort(patterns_.begin(), patterns_.end(),
                   [](const Pattern& a, const Pattern& b) { return a.letters > b.letters; });
}

std::string Translation::Filled(const Pattern& pattern,
                                const std::vector<std::string_view>& values) {
  std::string text;
  std::size_t next = 0;
  const std::string& form = pattern.translated;
  for (std::size_t i = 0; i < form.size(); ++i) {
    if ((form[i] == '{' || form[i] == '}') && i + 1 < form.size() && form[i + 1] == form[i]) {
      text += form[i++];
      continue;
    }
    if (form[i] != '{') {
      text += form[i];
      continue;
    }
    const std::size_t end = std::min(form.find('}', i), form.size());
    const std::string_view field(form.data() + i + 1, end - i - 1);
    std::size_t index = next++;
    if (!field.empty() && std::isdigit(static_cast<unsigned char>(field[0])))
      index = static_cast<std::size_t>(field[0] - '0');
    if (index < values.size()) {
      const std::string value(values[index]);
      text += field.ends_with(":t") ? Of(value) : value;
    }
    i = end;
  }
  return text;
}

bool Translation::Find(std::string_view english, std::string& translated) {
  if (const auto found = exact_.find(std::string(english)); found != exact_.end()) {
    translated = found->second;
    return true;
  }
  for (const Pattern& pattern : patterns_)
    if (const auto values = ValuesIn(english, pattern.pieces)) {
      translated = Filled(pattern, *values);
      return true;
    }
  return false;
}

const std::string& Translation::Of(const std::string& english) {
  if (is_english()) return english;
  if (const auto known = known_.find(english); known != known_.end()) return known->second;
  const auto is_blank = [](char c) { return c == ' ' || c == '\n'; };
  std::size_t first = 0, last = english.size();
  while (first < last && is_blank(english[first])) ++first;
  while (last > first && is_blank(english[last - 1])) --last;
  const std::string_view core(english.data() + first, last - first);
  std::string translated(core);
  if (!Find(core, translated) && LettersIn(core) > 0 && missing_.size() < kMostMissing)
    missing_.emplace(core);
  if (known_.size() > kMostKnown) known_.clear();
  return known_
      .insert_or_assign(english, english.substr(0, first) + translated + english.substr(last))
      .first->second;
}

std::string WordsOfMissing(const Translation& translation, const std::string& names) {
  if (translation.is_english()) return "the window is in English";
  constexpr std::string_view kUnits = " Mpx mm cm px ms Hz kHz MPa kPa mN rad kB MB GB EN DE CC0 ";
  std::string list;
  for (const std::string& text : translation.missing()) {
    std::string rest = text;
    std::istringstream lines(names);
    for (std::string name; std::getline(lines, name);)
      for (std::size_t at = rest.find(name); at != std::string::npos && !name.empty();
           at = rest.find(name))
        rest.replace(at, name.size(), " ");
    std::istringstream words(rest);
    const bool is_missing =
        std::any_of(std::istream_iterator<std::string>(words), {}, [&](const std::string& word) {
          const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)); };
          const auto first = std::find_if(word.begin(), word.end(), is_letter);
          const auto last = std::find_if(word.rbegin(), word.rend(), is_letter).base();
          const bool is_file = word.find('/') != std::string::npos;
          return last - first > 1 && !is_file &&
                 kUnits.find(" " + std::string(first, last) + " ") == std::string_view::npos;
        });
    if (is_missing) list += "\n  " + text;
  }
  return list.empty() ? "" : "these texts have no translation:" + list;
}

std::string Translation::Label(const std::string& name) {
  if (is_english()) return name;
  const std::size_t mark = name.find("##");
  const std::string words = name.substr(0, mark);
  const std::string& translated = Of(words);
  // ImGui keeps the identity that the English name gives.
  return translated == words ? name : translated + "###" + name;
}

}  // namespace arthro::app
