// window_words [TABLE.po]: lists the texts of the window that a table of translations lacks, by
// default the German one, one line each.
#include <cstdio>

#include "tests/documents/source_text.h"
#include "tests/documents/window_words.h"
#include "tests/support/build_paths.h"

int main(int argc, char** argv) {
  const std::string table = argc > 1 ? argv[1] : ARTHRO_SOURCE_DIR "/resources/languages/de.po";
  const auto words = arthro::test::WindowWords(ARTHRO_SOURCE_DIR);
  const auto missing = arthro::test::WordsWithoutTranslation(words, arthro::test::TextOf(table));
  for (const auto& word : missing) std::printf("%s: %s\n", word.place.c_str(), word.text.c_str());
  std::printf("%zu of %zu texts have no translation\n", missing.size(), words.size());
  return missing.empty() ? 0 : 1;
}
