// Words of the window in another language (app/platform/translation.h).
#include "app/platform/translation.h"

#include <gtest/gtest.h>

#include "simulation/core/error.h"

namespace arthro::app {
namespace {

Translation German() {
  return Translation(ParsePo(R"(msgid ""
msgstr "Content-Type: text/plain; charset=UTF-8\n"

# a comment
msgid "Save"
msgstr "Speichern"

msgid "Opened {}"
msgstr "Geöffnet: {}"

msgid "Undone: {}"
msgstr "Rückgängig: {0:t}"

msgid "{} of {} placed"
msgstr "{} von {} platziert"

msgid ""
"Two "
"parts"
msgstr ""
"Zwei "
"Teile"

#, fuzzy
msgid "Depth"
msgstr "Teufe"

msgid "{} {}"
msgstr "{1} {0}"
)"));
}

TEST(Translation, FindsWholeTextsAndKeepsWhatHasNoEntry) {
  Translation german = German();
  EXPECT_EQ(german.Of("Save"), "Speichern");
  EXPECT_EQ(german.Of("Two parts"), "Zwei Teile");
  EXPECT_EQ(german.Of("knee 7"), "knee 7");
  EXPECT_EQ(german.Of(" Save\n"), " Speichern\n");
  EXPECT_EQ(german.missing(), std::set<std::string>{"knee 7"});
}

TEST(Translation, FillsValuesIntoTheirPlaces) {
  Translation german = German();
  EXPECT_EQ(german.Of("Opened /tmp/Save"), "Geöffnet: /tmp/Save");
  EXPECT_EQ(german.Of("Undone: Save"), "Rückgängig: Speichern");
  EXPECT_EQ(german.Of("12 of 20 placed"), "12 von 20 platziert");
}

TEST(Translation, ASentenceIsNotTakenForAName) {
  Translation german = German();
  EXPECT_EQ(german.Of("Opened scenes are listed here."), "Opened scenes are listed here.");
}

TEST(Translation, FuzzyEntriesAndFormsWithoutWordsAreNotUsed) {
  Translation german = German();
  EXPECT_EQ(german.Of("Depth"), "Depth");
  EXPECT_EQ(german.Of("a b"), "a b");
}

TEST(Translation, ALabelKeepsTheIdentityOfItsEnglishName) {
  Translation german = German();
  EXPECT_EQ(german.Label("Save##2"), "Speichern###Save##2");
  EXPECT_EQ(german.Label("knee##2"), "knee##2");
  EXPECT_EQ(Translation().Label("Save##2"), "Save##2");
}

TEST(Translation, WhatIsMissingIsListedWithoutNamesUnitsAndFiles) {
  Translation german = German();
  for (const char* text : {"Save", "my knee", "12.5 mm", "/tmp/knee/scene.json", "a knee of 3 kB"})
    german.Of(text);
  EXPECT_EQ(WordsOfMissing(german, "my knee\n"),
            "these texts have no translation:\n  a knee of 3 kB");
  EXPECT_EQ(WordsOfMissing(german, "my knee\na knee of\n"), "");
  EXPECT_NE(WordsOfMissing(Translation(), ""), "") << "English lacks nothing, and tells nothing";
}

TEST(Translation, AMistakeInATableIsToldWithItsLine) {
  for (const char* text : {"\nmsgid \"a\nmsgstr \"b\"", "msgid \"a\"\nmsgid_plural \"b\""}) {
    try {
      ParsePo(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("line 2"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace arthro::app
