// Every text of the window has a German one, or is named here as missing.
#include "tests/documents/window_words.h"

#include <gtest/gtest.h>

#include "tests/documents/source_text.h"
#include "tests/support/build_paths.h"

namespace arthro::test {
namespace {

TEST(WindowWords, AreCollectedWithTheirPlace) {
  const auto words = WindowWords(ARTHRO_SOURCE_DIR);
  ASSERT_GT(words.size(), 700u);
  const auto is_there = [&](const char* text) {
    for (const WindowWord& word : words)
      if (word.text == text) return true;
    return false;
  };
  EXPECT_TRUE(is_there("Make depth from the picture"));
  EXPECT_TRUE(is_there("Relief of the brightest, nearest tissue."));
  EXPECT_TRUE(is_there("Save \"{}\" before you {}?"));
  EXPECT_FALSE(is_there("step-depth"));
}

TEST(WindowWords, ATextWithoutAnEntryIsNamed) {
  const std::vector<WindowWord> words = {
      {"Save", "a"}, {"Open {}", "b"}, {"Depth", "c"}, {"Sav", "d"}, {"Open", "e"}};
  const auto missing = WordsWithoutTranslation(
      words,
      "msgid \"\"\nmsgstr \"\"\n\nmsgid \"Save\"\nmsgstr \"x\"\n\nmsgid \"Open \"\n"
      "\"{}\"\nmsgstr \"y\"\n");
  ASSERT_EQ(missing.size(), 2u);
  EXPECT_EQ(missing[0].text, "Depth");
  EXPECT_EQ(missing[1].text, "Sav") << "a part of another text is no entry";
}

TEST(WindowWords, HaveAGermanTranslation) {
  const auto words = WindowWords(ARTHRO_SOURCE_DIR);
  const auto missing = WordsWithoutTranslation(
      words, TextOf(std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources/languages/de.po"));
  std::string list;
  for (const WindowWord& word : missing) list += word.place + ": " + word.text + "\n";
  EXPECT_TRUE(missing.empty()) << missing.size() << " of " << words.size()
                               << " texts have no German:\n"
                               << list;
}

}  // namespace
}  // namespace arthro::test
