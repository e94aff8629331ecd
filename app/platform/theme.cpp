#include "app/platform/theme.h"

#include <cmath>
#include <filesystem>

#include <imgui.h>

namespace arthro::app {
namespace {

constexpr double kTextSize = 15.0, kHeadingSize = 17.0, kLargeSize = 34.0;  // px at scale 1

// Latin with accents, Greek, Cyrillic, dashes and quotes, arrows, mathematical signs, boxes.
constexpr ImWchar kRanges[] = {0x0020, 0x024F, 0x0370, 0x03FF, 0x0400, 0x04FF,
                               0x2010, 0x2044, 0x2190, 0x21FF, 0x2200, 0x22FF,
                               0x25A0, 0x25FF, 0x2713, 0x2717, 0};
constexpr ImWchar kDigitRanges[] = {0x0020, 0x00FF, 0x2013, 0x2014, 0};

// Signs that ImGui's own font lacks, and the nearest that it has.
constexpr struct {
  ImWchar sign, nearest;
} kNearestSigns[] = {{0x2026, 0x85}, {0x2212, '-'},  {0x2010, '-'},  {0x2011, '-'}, {0x2013, '-'},
                     {0x2014, '-'},  {0x2018, '\''}, {0x2019, '\''}, {0x201C, '"'}, {0x201D, '"'},
                     {0x201E, '"'},  {0x2192, '>'},  {0x2190, '<'},  {0x2264, '<'}, {0x2265, '>'},
                     {0x2022, 0xB7}, {0x2717, 'x'},  {0x25CB, 'o'}};

// Null where no folder has the file.
ImFont* AddFont(std::span<const std::filesystem::path> folders, const char* name, double size,
                const ImWchar* ranges) {
  for (const auto& folder : folders)
    if (const auto file = folder / name; std::filesystem::exists(file))
      return ImGui::GetIO().Fonts->AddFontFromFileTTF(
          file.c_str(), static_cast<float>(std::round(size)), nullptr, ranges);
  return nullptr;
}

ImFont* AddOwnFont(double size) {
  ImFontConfig config;
  config.SizePixels = static_cast<float>(std::round(size * 13.0 / 15.0));
  return ImGui::GetIO().Fonts->AddFontDefault(&config);
}

ImVec4 Rgb(unsigned rgb, float alpha = 1.0f) {
  return {static_cast<float>((rgb >> 16) & 0xFF) / 255.0f,
          static_cast<float>((rgb >> 8) & 0xFF) / 255.0f, static_cast<float>(rgb & 0xFF) / 255.0f,
          alpha};
}

void ColourDark(ImVec4* c) {
  c[ImGuiCol_Text] = Rgb(0xE9EBEE);
  c[ImGuiCol_TextDisabled] = Rgb(0xA2AAB4);
  c[ImGuiCol_WindowBg] = Rgb(0x1B1E23);
  c[ImGuiCol_ChildBg] = Rgb(0x1B1E23, 0.0f);
  c[ImGuiCol_PopupBg] = Rgb(0x23272E);
  c[ImGuiCol_Border] = Rgb(0x3A4049);
  c[ImGuiCol_FrameBg] = Rgb(0x2C323B);
  c[ImGuiCol_FrameBgHovered] = Rgb(0x37404B);
  c[ImGuiCol_FrameBgActive] = Rgb(0x3F4A57);
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = Rgb(0x2A3038);
  c[ImGuiCol_MenuBarBg] = Rgb(0x23272E);
  c[ImGuiCol_ScrollbarBg] = Rgb(0x1B1E23);
  c[ImGuiCol_ScrollbarGrab] = Rgb(0x454D58);
  c[ImGuiCol_ScrollbarGrabHovered] = Rgb(0x566070);
  c[ImGuiCol_ScrollbarGrabActive] = Rgb(0x66738A);
  c[ImGuiCol_CheckMark] = Rgb(0x4AB2D6);
  c[ImGuiCol_SliderGrab] = Rgb(0x4AB2D6);
  c[ImGuiCol_SliderGrabActive] = Rgb(0x7FD0EC);
  c[ImGuiCol_Button] = Rgb(0x343B45);
  c[ImGuiCol_ButtonHovered] = Rgb(0x425063);
  c[ImGuiCol_ButtonActive] = Rgb(0x2A6E8A);
  c[ImGuiCol_PlotHistogram] = Rgb(0x2F8FB5);  // bars of progress
  c[ImGuiCol_Header] = Rgb(0x2A5266);
  c[ImGuiCol_HeaderHovered] = Rgb(0x33637A);
  c[ImGuiCol_HeaderActive] = Rgb(0x2A6E8A);
  c[ImGuiCol_Separator] = Rgb(0x3A4049);
  c[ImGuiCol_TextSelectedBg] = Rgb(0x2A6E8A);
  c[ImGuiCol_NavHighlight] = Rgb(0x4AB2D6);
  c[ImGuiCol_ModalWindowDimBg] = Rgb(0x0A0C0F, 0.6f);
  c[ImGuiCol_TableHeaderBg] = Rgb(0x2A3038);
  c[ImGuiCol_TableBorderLight] = c[ImGuiCol_TableBorderStrong] = Rgb(0x3A4049);
  c[ImGuiCol_TableRowBgAlt] = Rgb(0x20242A);
}

void ColourLight(ImVec4* c) {
  c[ImGuiCol_Text] = Rgb(0x1A1D22);
  c[ImGuiCol_TextDisabled] = Rgb(0x565E69);
  c[ImGuiCol_WindowBg] = Rgb(0xF4F5F7);
  c[ImGuiCol_ChildBg] = Rgb(0xF4F5F7, 0.0f);
  c[ImGuiCol_PopupBg] = Rgb(0xE7E9ED);
  c[ImGuiCol_Border] = Rgb(0xBFC5CE);
  c[ImGuiCol_FrameBg] = Rgb(0xDADEE4);
  c[ImGuiCol_FrameBgHovered] = Rgb(0xCBD2DB);
  c[ImGuiCol_FrameBgActive] = Rgb(0xBCC6D2);
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = Rgb(0xDADEE4);
  c[ImGuiCol_MenuBarBg] = Rgb(0xE7E9ED);
  c[ImGuiCol_ScrollbarBg] = Rgb(0xF4F5F7);
  c[ImGuiCol_ScrollbarGrab] = Rgb(0xB3BAC4);
  c[ImGuiCol_ScrollbarGrabHovered] = Rgb(0x99A2AE);
  c[ImGuiCol_ScrollbarGrabActive] = Rgb(0x7F8A99);
  c[ImGuiCol_CheckMark] = Rgb(0x0F6F93);
  c[ImGuiCol_SliderGrab] = Rgb(0x0F6F93);
  c[ImGuiCol_SliderGrabActive] = Rgb(0x0A5570);
  c[ImGuiCol_Button] = Rgb(0xD3D9E0);
  c[ImGuiCol_ButtonHovered] = Rgb(0xBFCBD8);
  c[ImGuiCol_ButtonActive] = Rgb(0x8CC7DE);
  c[ImGuiCol_PlotHistogram] = Rgb(0x2F8FB5);  // bars of progress
  c[ImGuiCol_Header] = Rgb(0xBFDDE9);
  c[ImGuiCol_HeaderHovered] = Rgb(0xA9D0E0);
  c[ImGuiCol_HeaderActive] = Rgb(0x8CC7DE);
  c[ImGuiCol_Separator] = Rgb(0xBFC5CE);
  c[ImGuiCol_TextSelectedBg] = Rgb(0x8CC7DE);
  c[ImGuiCol_NavHighlight] = Rgb(0x0F6F93);
  c[ImGuiCol_ModalWindowDimBg] = Rgb(0x3A4049, 0.6f);
  c[ImGuiCol_TableHeaderBg] = Rgb(0xDADEE4);
  c[ImGuiCol_TableBorderLight] = c[ImGuiCol_TableBorderStrong] = Rgb(0xBFC5CE);
  c[ImGuiCol_TableRowBgAlt] = Rgb(0xECEEF1);
}

}  // namespace

std::span<const std::filesystem::path> FontFolders() {
  static const std::filesystem::path folders[] = {
      "/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu",
      "/usr/share/fonts/dejavu-sans-fonts", "/usr/share/fonts/TTF"};
  return folders;
}

Fonts BuildFonts(double scale, std::span<const std::filesystem::path> folders) {
  ImGui::GetIO().Fonts->Clear();
  constexpr const char *kRegular = "DejaVuSans.ttf", *kBold = "DejaVuSans-Bold.ttf";
  Fonts fonts;
  fonts.text = AddFont(folders, kRegular, kTextSize * scale, kRanges);
  const bool has_signs = fonts.text != nullptr;
  if (!has_signs) fonts.text = AddOwnFont(kTextSize * scale);
  fonts.heading = AddFont(folders, kBold, kHeadingSize * scale, kRanges);
  if (!fonts.heading) fonts.heading = fonts.text;
  fonts.large = AddFont(folders, kBold, kLargeSize * scale, kDigitRanges);
  if (!fonts.large) fonts.large = AddOwnFont(kLargeSize * scale);
  if (!has_signs) {
    ImGui::GetIO().Fonts->Build();
    for (const auto& [sign, nearest] : kNearestSigns) fonts.text->AddRemapChar(sign, nearest);
  }
  return fonts;
}

void ApplyTheme(double scale, Theme theme) {
  ImGuiStyle style;
  if (theme == Theme::kDark)
    ImGui::StyleColorsDark(&style);
  else
    ImGui::StyleColorsLight(&style);
  style.WindowPadding = {12, 10};
  style.FramePadding = {9, 6};
  style.ItemSpacing = {8, 7};
  style.ItemInnerSpacing = {7, 5};
  style.ScrollbarSize = 15;
  style.GrabMinSize = 16;
  style.FrameRounding = 4;
  style.GrabRounding = 3;
  style.PopupRounding = 4;
  style.ChildRounding = 0;
  style.WindowRounding = 5;
  style.WindowBorderSize = 1;
  style.ChildBorderSize = 0;
  style.FrameBorderSize = 0;
  style.DisabledAlpha = 0.45f;
  style.ScaleAllSizes(static_cast<float>(scale));

  if (theme == Theme::kDark)
    ColourDark(style.Colors);
  else
    ColourLight(style.Colors);
  ImGui::GetStyle() = style;
}

Theme CurrentTheme() {
  return ImGui::GetStyleColorVec4(ImGuiCol_WindowBg).x < 0.5f ? Theme::kDark : Theme::kLight;
}

unsigned OnGround(unsigned colour) {
  if (CurrentTheme() == Theme::kDark) return colour;
  switch (colour) {  // contrast to the light ground at least 4.5:1, of text 7:1
    case kAccent:
      return 0xFF8A5F06;
    case kGood:
      return 0xFF2E6B1E;
    case kWarning:
      return 0xFF00518A;
    case kBad:
      return 0xFF1E1EB0;
    case kQuiet:
      return 0xFF554C44;
    case kBright:
      return 0xFF221D1A;
    default:
      return colour;
  }
}

}  // namespace arthro::app
