// Texts that the window shows, collected from the string literals of its sources, and those that a
// table of translations (resources/languages/*.po) lacks.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace arthro::test {

struct WindowWord {
  std::string text;   // its values as {}
  std::string place;  // file and line of its first literal
};
// Each text once, in the order of the files.
std::vector<WindowWord> WindowWords(const std::filesystem::path& root);

// Those that no entry of the table contains.
std::vector<WindowWord> WordsWithoutTranslation(const std::vector<WindowWord>& words,
                                                std::string_view table);

}  // namespace arthro::test
