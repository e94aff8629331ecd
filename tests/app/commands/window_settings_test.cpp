// Looks and language of the window (app/state/settings/window_settings.h).
#include "app/state/settings/window_settings.h"

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

TEST(WindowSettings, AutomaticScaleFollowsTheMonitor) {
  EXPECT_EQ(ScaleOf(UiScale::kAutomatic, {2.0, 3840, 600}), 2.0);  // the system says so
  EXPECT_EQ(ScaleOf(UiScale::kAutomatic, {1.0, 1920, 520}), 1.0);  // a usual monitor
  EXPECT_EQ(ScaleOf(UiScale::kAutomatic, {1.0, 3840, 600}), 1.0);  // a large one with many pixels
  EXPECT_EQ(ScaleOf(UiScale::kAutomatic, {1.0, 3840, 344}), 2.0);  // a dense laptop
  EXPECT_EQ(ScaleOf(UiScale::kAutomatic, {1.0, 2560, 300}), 1.5);
  EXPECT_EQ(ScaleOf(UiScale::kAutomatic, {1.0, 3840, 0}), 1.0);  // size not known
  EXPECT_EQ(ScaleOf(UiScale::k150, {2.0, 3840, 344}), 1.5);
}

TEST(WindowSettings, LanguageFollowsTheEnvironmentInGettextsOrder) {
  for (const char* name : {"LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"}) ::unsetenv(name);
  EXPECT_STREQ(LanguageCode(LanguageChoice::kAutomatic), "en");
  ::setenv("LANG", "de_DE.UTF-8", 1);
  EXPECT_STREQ(LanguageCode(LanguageChoice::kAutomatic), "de");
  ::setenv("LC_ALL", "C", 1);
  EXPECT_STREQ(LanguageCode(LanguageChoice::kAutomatic), "en");
  ::setenv("LANGUAGE", "sv:de:en", 1);
  EXPECT_STREQ(LanguageCode(LanguageChoice::kAutomatic), "de");
  EXPECT_STREQ(LanguageCode(LanguageChoice::kEnglish), "en");
}

TEST(WindowSettings, AreKeptInAFileAndADamagedOneGivesDefaults) {
  const test::TempFolder folder;
  const auto file = folder / "own" / "settings.json";
  const WindowSettings chosen = {UiScale::k150, ThemeChoice::kLight, LanguageChoice::kGerman};
  WriteWindowSettings(file, chosen);
  EXPECT_EQ(ReadWindowSettings(file), chosen);
  std::ofstream(file) << "{\"theme\": \"pink\"}";
  EXPECT_EQ(ReadWindowSettings(file), WindowSettings());
}

}  // namespace
}  // namespace arthro::app
