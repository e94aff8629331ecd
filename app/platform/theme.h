// Fonts and colours: a calm dark and a light theme, text at 15 px a unit of content scale, contrast
// of text to ground at least 7:1. Fonts are the system's DejaVu Sans, which has Greek, arrows and
// the signs that the panels use. Without it ImGui's own font stands in: dots, dashes, quotes and
// arrows show as the nearest sign that it has, Greek as "?".
#pragma once

#include <filesystem>
#include <span>

struct ImFont;

namespace arthro::app {

struct Fonts {
  ImFont* text = nullptr;
  ImFont* heading = nullptr;  // bold
  ImFont* large = nullptr;    // numbers of practice, readable from arm's length
};

// Folders in which systems keep DejaVu Sans.
std::span<const std::filesystem::path> FontFolders();

// Fills ImGui's font atlas anew; the caller gives the texture to OpenGL.
Fonts BuildFonts(double scale, std::span<const std::filesystem::path> folders = FontFolders());

enum class Theme { kDark, kLight };

// Colours, spacing and sizes of every widget.
void ApplyTheme(double scale, Theme theme);
Theme CurrentTheme();  // the theme of ApplyTheme, read from ImGui's style

// A colour below as it is drawn on the ground of the current theme; over a picture, which is dark
// in either theme, they are drawn as they are. Other colours stay as they are.
unsigned OnGround(unsigned colour);

// Colours that carry a meaning, 0xAABBGGRR as ImDrawList takes them.
inline constexpr unsigned kAccent = 0xFFD6B24A;      // teal blue: chosen, active
inline constexpr unsigned kMarkShadow = 0xC0000000;  // about a mark on a picture
inline constexpr unsigned kGood = 0xFF7CC47A;        // green
inline constexpr unsigned kWarning = 0xFF4DB8F2;     // amber
inline constexpr unsigned kBad = 0xFF6A6AF0;         // red
inline constexpr unsigned kQuiet = 0xFFB4AAA2;       // secondary text
inline constexpr unsigned kBright = 0xFFEEEBE9;      // numbers

}  // namespace arthro::app
