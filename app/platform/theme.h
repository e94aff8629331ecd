// Fonts and colours: a calm dark theme, text at 15 px a unit of content scale, contrast of text to
// ground at least 7:1. Fonts are the system's DejaVu Sans, which has Greek, arrows and the signs
// that the panels use; without it ImGui's own font stands in and the signs show as "?".
#pragma once

struct ImFont;

namespace arthro::app {

struct Fonts {
  ImFont* text = nullptr;
  ImFont* heading = nullptr;  // bold
  ImFont* large = nullptr;    // numbers of practice, readable from arm's length
  bool has_signs = false;     // Greek, arrows, …
};

// Fills ImGui's font atlas anew; the caller gives the texture to OpenGL.
Fonts BuildFonts(double scale);

// Colours, spacing and sizes of every widget.
void ApplyTheme(double scale);

// Colours that carry a meaning, 0xAABBGGRR as ImDrawList takes them.
inline constexpr unsigned kAccent = 0xFFD6B24A;   // teal blue: chosen, active
inline constexpr unsigned kGood = 0xFF7CC47A;     // green
inline constexpr unsigned kWarning = 0xFF4DB8F2;  // amber
inline constexpr unsigned kBad = 0xFF6A6AF0;      // red
inline constexpr unsigned kQuiet = 0xFFB4AAA2;    // secondary text
inline constexpr unsigned kBright = 0xFFEEEBE9;   // numbers

}  // namespace arthro::app
