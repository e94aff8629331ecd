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
                                      "app/view/overview/overview.h",
                                      "authoring/models/meniscus_tear.cpp",
                                      "authoring/models/model_library.cpp",
                                      "simulation/practice/reach/named_portals.cpp",
                                      "simulation/practice/reach/reach_picture.cpp",
                                      "app/platform/file_browser",
                                      "app/platform/picture_window"};
  constexpr const char* kOptions[] = {"authoring/depth/depth_options.h", "authoring/panorama/",
                                      "simulation/haptics/",
                                      "simulation/practice/session_options.h"};
  const auto starts = [&](const char* folder) { return file.starts_with(folder); };
  if (file.find("/script_record") != std::string::npos) return false;
  if (file.ends_with("file_browser_model_test.cpp")) return false;
  // Helps of files that nobody writes by hand.
  for (const char* kept : {"/scene_lock.cpp", "/view_layout.h", "/instructor_choice.h"})
    if (file.ends_with(kept)) return false;
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

// A text for people: words with a blank or a capital, and no name of a file, key, function or value
// of a script.
bool IsForPeople(const std::string& text) {
  static const std::regex two_letters("[A-Za-z]{2}"), identifier("[a-z0-9_.+*/|=-]*"),
      call("gl[A-Z].*|GLFW.*|XDG.*|HOME|LANG.*|LC_.*|([A-Z_]+ ?)+(…)?"),
      unit("[{}%. 0-9a-z³°/×µ]{0,12}"),
      raw(".*%[.0-9]*[a-z].*|arthroscene:.*|.*\\.(po|json|png|vtu|html)|.*\\[\\{\\}\\]");
  // Identities of ImGui's windows, tables and lists.
  static const std::set<std::string> kHidden = {
      "file menu", "start content", "overview mouse", "depth board", "depth map", "inset overview",
      "tear preview", "depth view", "footage board", "Picture", "Handle", "cohort choice",
      "metric choice", "debrief plots",
      // Names of methods and of the program, alike in every language.
      "SURF", "SIFT", "AKAZE", "ORB", "English", "Deutsch", "— Arthroscene", "Touch (OpenHaptics)",
      // A folder's name, a comment of a script, and what a compiler or a terminal says.
      "session-XXXXXX", "a number that is shown needs a range",
      "the script ended with a message: {}: {}",
      "# The hands of a practice follow time and are not here; practise --log records them.",
      "insertion,roll_deg,u_px,v_px", "drag {} {} {}"};
  const std::string words = std::regex_replace(text, std::regex("\\{\\}"), "");
  return std::regex_search(words, two_letters) && !std::regex_match(text, identifier) &&
         !std::regex_match(text, call) && !std::regex_match(text, unit) &&
         !std::regex_match(text, raw) && !kHidden.contains(text);
}

// The English texts of a .po file, and the parts of each that its values separate: a source may put
// a text together of such parts.
std::set<std::string> EnglishOf(std::string_view table) {
  std::set<std::string> all;
  for (std::size_t at = table.find("\nmsgid "); at != std::string_view::npos;
       at = table.find("\nmsgid ", at + 1)) {
    const std::size_t end = table.find("\nmsgstr ", at);
    std::string text;
    const std::string part(table.substr(at + 7, end - at - 7));
    static const std::regex quoted("\"((?:[^\"\\\\]|\\\\.)*)\"");
    for (std::sregex_iterator it(part.begin(), part.end(), quoted), none; it != none; ++it)
      text += (*it)[1].str();
    const std::string plain = Plain(text);
    all.insert(plain);
    std::vector<std::size_t> ends = {0};  // ends of the values; the text's own ends
    for (std::size_t value = plain.find("{}"); value != std::string::npos;
         value = plain.find("{}", value + 2))
      ends.push_back(value + 2);
    ends.push_back(plain.size() + 2);
    for (std::size_t first = 0; first + 1 < ends.size(); ++first)
      for (std::size_t last = first + 1; last < ends.size(); ++last)
        all.insert(Plain(plain.substr(ends[first], ends[last] - 2 - ends[first])));
  }
  return all;
}

// A text that begins with punctuation goes on after another one, and is a part of an entry.
bool GoesOn(const std::string& text, const std::set<std::string>& english) {
  return std::string_view(",;.:").find(text.front()) != std::string_view::npos &&
         std::any_of(english.begin(), english.end(), [&](const std::string& entry) {
           return entry.find(text) != std::string::npos;
         });
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
  const std::set<std::string> english = EnglishOf(table);
  std::vector<WindowWord> missing;
  for (const WindowWord& word : words)
    if (!english.contains(word.text) && !GoesOn(word.text, english)) missing.push_back(word);
  return missing;
}

}  // namespace arthro::test
