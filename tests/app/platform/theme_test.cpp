// Fonts of the window, where the system has DejaVu Sans and where it has none.
#include "app/platform/theme.h"

#include <gtest/gtest.h>
#include <imgui.h>

namespace arthro::app {
namespace {

class Theme : public testing::Test {
 protected:
  void SetUp() override { ImGui::CreateContext(); }
  void TearDown() override { ImGui::DestroyContext(); }
};

// "Save as…", "50–80 %", "−21°": a "?" at the end of a button's name reads as a question.
TEST_F(Theme, SignsOfWordsAreReadableWithoutDejaVu) {
  const Fonts fonts = BuildFonts(1.0, {});
  for (const ImWchar sign : {0x2026, 0x2013, 0x2212, 0x201E, 0x201C, 0x2192, 0x2264})
    EXPECT_NE(fonts.text->FindGlyphNoFallback(sign), nullptr) << std::hex << sign;
  EXPECT_EQ(fonts.text->FindGlyphNoFallback(0x2026)->Codepoint, 0x85u) << "three dots";
  EXPECT_NE(fonts.large->FindGlyphNoFallback('0'), nullptr);
}

TEST_F(Theme, FolderWithoutTheFontIsPassedOver) {
  const std::filesystem::path nowhere[] = {"/nowhere"};
  const Fonts fonts = BuildFonts(2.0, nowhere);
  EXPECT_NE(fonts.text, nullptr);
  EXPECT_NE(fonts.heading, nullptr);
}

TEST_F(Theme, DejaVuHasEverySign) {
  bool is_there = false;
  for (const auto& folder : FontFolders())
    is_there |= std::filesystem::exists(folder / "DejaVuSans.ttf");
  if (!is_there) GTEST_SKIP() << "SKIPPED: DejaVu Sans is not on this machine";
  const Fonts fonts = BuildFonts(1.0);
  ImGui::GetIO().Fonts->Build();
  for (const ImWchar sign : {0x2026, 0x2212, 0x03B8, 0x2192, 0x2717, 0x2264})
    EXPECT_EQ(fonts.text->FindGlyphNoFallback(sign)->Codepoint, sign) << std::hex << sign;
}

}  // namespace
}  // namespace arthro::app
