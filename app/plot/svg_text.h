// Text and colours of plots in SVG and of the pages that hold them.
#pragma once

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

namespace arthro::app {

// Text as it stands in XML and HTML, in an element or in a quoted attribute.
inline std::string XmlText(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

// Colours that people with any common colour blindness tell apart [Okabe & Ito 2008].
inline constexpr std::array kSeriesColours = {"#0072B2", "#D55E00", "#009E73",
                                              "#CC79A7", "#E69F00", "#56B4E9"};

// Width in px of a text of DejaVu Sans: the mean width of its characters, with a reserve.
inline double TextWidth(const std::string& text, double font) {
  constexpr double kGlyph = 0.64;  // width of a character per px of its font
  const auto glyphs = std::count_if(text.begin(), text.end(), [](char c) {
    return (c & 0xC0) != 0x80;
  });  // counts UTF-8 characters
  return kGlyph * font * static_cast<double>(glyphs);
}

// Begin of a picture on white; "</svg>" ends it.
inline std::string SvgHead(double width, double height) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" "
      "height=\"{1:g}\" font-family=\"DejaVu Sans, sans-serif\">\n"
      "<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"#ffffff\"/>\n",
      width, height);
}

// `anchor`: start, middle or end.
inline std::string SvgText(double x, double y, double font, const char* anchor, const char* colour,
                           const std::string& text) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:g}\" text-anchor=\"{}\" fill=\"{}\">{}"
      "</text>\n",
      x, y, font, anchor, colour, XmlText(text));
}

}  // namespace arthro::app
