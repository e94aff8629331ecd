#include "simulation/scene/backdrop/clean_picture.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace arthro {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n"sv;
constexpr std::string_view kJpegSignature = "\xff\xd8\xff"sv;

std::uint8_t Byte(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint8_t>(bytes[at]);
}

// ---- PNG [ISO/IEC 15948, 5]: length, type, data, checksum, again and again. ----
std::optional<std::string> CleanPng(std::string_view bytes) {
  constexpr std::array kKept = {"IHDR"sv, "PLTE"sv, "tRNS"sv, "gAMA"sv,
                                "cHRM"sv, "sRGB"sv, "IDAT"sv, "IEND"sv};
  constexpr std::size_t kFrame = 12;  // bytes of a chunk besides its data
  std::string clean(kPngSignature);
  for (std::size_t at = kPngSignature.size(); at + kFrame <= bytes.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | Byte(bytes, at + i);
    if (length > bytes.size() - at - kFrame) return std::nullopt;
    const std::string_view type = bytes.substr(at + 4, 4);
    const bool is_kept = std::find(kKept.begin(), kKept.end(), type) != kKept.end();
    const bool is_critical = (Byte(bytes, at + 4) & 0x20) == 0;
    if (is_critical && !is_kept) return std::nullopt;  // from a later version of the format
    if (is_kept) clean += bytes.substr(at, length + kFrame);
    if (type == "IEND"sv) return clean;
    at += length + kFrame;
  }
  return std::nullopt;
}

// ---- JPEG [ITU-T T.81, B]: markers with segments; entropy-coded bytes follow a scan's header.
// ----
bool StandsAlone(std::uint8_t marker) { return marker == 0x01 || (marker & 0xf8) == 0xd0; }

// Frame and scan headers, Huffman, quantization and arithmetic tables, restart interval, lines.
bool IsNeededToDecode(std::uint8_t marker) {
  const bool is_frame_or_table = marker >= 0xc0 && marker <= 0xcf && marker != 0xc8;
  return is_frame_or_table || (marker >= 0xda && marker <= 0xdd);
}

void AppendSegment(std::string& to, char marker, std::string_view data) {
  const std::size_t length = data.size() + 2;
  to += {'\xff', marker, static_cast<char>(length >> 8), static_cast<char>(length & 0xff)};
  to += data;
}

// Part of an application's segment that is kept: the few bytes that say how colours are coded.
void AppendApplication(std::string& to, std::uint8_t marker, std::string_view data) {
  constexpr std::size_t kJfifBytes = 14, kAdobeBytes = 12;
  if (marker == 0xe0 && data.starts_with("JFIF\0"sv) && data.size() >= kJfifBytes) {
    std::string header(data.substr(0, kJfifBytes));
    header[12] = header[13] = 0;  // width and height of its thumbnail
    AppendSegment(to, '\xe0', header);
  } else if (marker == 0xee && data.starts_with("Adobe"sv) && data.size() >= kAdobeBytes) {
    AppendSegment(to, '\xee', data.substr(0, kAdobeBytes));
  }
}

std::optional<std::string> CleanJpeg(std::string_view bytes) {
  std::string clean = "\xff\xd8";
  std::size_t at = 2;
  while (true) {
    // A marker, behind any number of fill bytes.
    if (at >= bytes.size() || Byte(bytes, at) != 0xff) return std::nullopt;
    while (at < bytes.size() && Byte(bytes, at) == 0xff) ++at;
    if (at >= bytes.size()) return std::nullopt;
    const std::uint8_t marker = Byte(bytes, at++);
    if (marker == 0xd9) return clean + "\xff\xd9";
    if (StandsAlone(marker)) continue;
    if (at + 2 > bytes.size()) return std::nullopt;
    const std::size_t length = std::size_t{Byte(bytes, at)} << 8 | Byte(bytes, at + 1);
    if (length < 2 || length > bytes.size() - at) return std::nullopt;
    const std::string_view data = bytes.substr(at + 2, length - 2);
    at += length;
    if (IsNeededToDecode(marker))
      AppendSegment(clean, static_cast<char>(marker), data);
    else
      AppendApplication(clean, marker, data);
    if (marker != 0xda) continue;
    // The scan's bytes end at a marker that is neither a stuffed zero nor a restart.
    const std::size_t begin = at;
    for (; at + 1 < bytes.size(); ++at)
      if (Byte(bytes, at) == 0xff && Byte(bytes, at + 1) != 0 && Byte(bytes, at + 1) != 0xff &&
          !StandsAlone(Byte(bytes, at + 1)))
        break;
    if (at + 1 >= bytes.size()) return std::nullopt;
    clean += bytes.substr(begin, at - begin);
  }
}

}  // namespace

std::optional<std::string> PictureWithoutMetadata(std::string_view bytes) {
  if (bytes.starts_with(kPngSignature)) return CleanPng(bytes);
  if (bytes.starts_with(kJpegSignature)) return CleanJpeg(bytes);
  return std::nullopt;
}

}  // namespace arthro
