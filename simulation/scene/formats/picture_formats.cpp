#include "simulation/scene/formats/picture_formats.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

// An unsigned number of `size` bytes at `at`; 0 behind the end.
std::uint32_t NumberAt(std::string_view bytes, std::size_t at, int size, bool is_big_endian) {
  if (at > bytes.size() || bytes.size() - at < static_cast<std::size_t>(size)) return 0;
  std::uint32_t number = 0;
  for (int i = 0; i < size; ++i) {
    const int from = is_big_endian ? i : size - 1 - i;
    number = number << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(from)]);
  }
  return number;
}

// Takes a number off the front, behind blanks and comments.
std::optional<std::uint64_t> TakePnmNumber(std::string_view& text) {
  while (!text.empty() && (std::isspace(text.front() & 0xff) || text.front() == '#')) {
    const bool is_comment = text.front() == '#';
    const std::size_t end = is_comment ? text.find('\n') : 1;
    text.remove_prefix(std::min(end, text.size()));
  }
  std::uint64_t number = 0;
  std::size_t digits = 0;
  while (digits < text.size() && digits < 10 && std::isdigit(text[digits] & 0xff))
    number = number * 10 + static_cast<std::uint64_t>(text[digits++] - '0');
  text.remove_prefix(digits);
  if (digits == 0) return std::nullopt;
  return number;
}

int OrientationOf(std::string_view exif) {
  const bool is_big_endian = exif.starts_with("MM\0*"sv);
  if (!is_big_endian && !exif.starts_with("II*\0"sv)) return 1;
  const std::size_t directory = NumberAt(exif, 4, 4, is_big_endian);
  const std::uint32_t entries = NumberAt(exif, directory, 2, is_big_endian);
  for (std::uint32_t i = 0; i < entries; ++i) {
    constexpr std::uint32_t kOrientation = 0x0112;
    const std::size_t entry = directory + 2 + std::size_t{12} * i;
    if (NumberAt(exif, entry, 2, is_big_endian) == kOrientation)
      return static_cast<int>(NumberAt(exif, entry + 8, 2, is_big_endian));
  }
  return 1;
}

}  // namespace

PictureFormat FormatOf(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) return PictureFormat::kPng;
  if (bytes.starts_with("\xff\xd8\xff"sv)) return PictureFormat::kJpeg;
  if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv) ||
      bytes.starts_with("II+\0"sv) || bytes.starts_with("MM\0+"sv))
    return PictureFormat::kTiff;
  if (bytes.starts_with("BM"sv) && bytes.size() >= 26) return PictureFormat::kBmp;
  if (bytes.starts_with("RIFF"sv) && bytes.size() > 12 && bytes.substr(8).starts_with("WEBP"sv))
    return PictureFormat::kWebp;
  if (bytes.starts_with("\x76\x2f\x31\x01"sv)) return PictureFormat::kExr;
  if (bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6' &&
      std::isspace(bytes[2] & 0xff))
    return PictureFormat::kPnm;
  return PictureFormat::kUnknown;
}

void RequireSize(std::uint64_t width, std::uint64_t height, std::string_view bytes,
                 const fs::path& file) {
  if (width == 0 || height == 0) RefuseDamagedPicture(file);
  if (width <= kMaxPixels / height) {
    const std::uint64_t pixels = width * height;
    if (pixels <= kMostFreePixels || pixels / kMostPixelsPerByte <= bytes.size()) return;
    throw Error(Code::kBadImage,
                fmt::format("this picture claims {} x {} pixels in a file of {} kB, which no photo "
                            "needs; make it smaller or export it again",
                            width, height, (bytes.size() + 1023) / 1024),
                file);
  }
  throw Error(Code::kBadImage,
              fmt::format("this picture is {} x {} pixels; at most 16384 x 16384 can be used",
                          width, height),
              file);
}

void RefuseCutOff(const fs::path& file) {
  throw Error(Code::kBadImage, "this picture is cut off before its end; copy or export it again",
              file);
}

void RefuseDamagedPicture(const fs::path& file) {
  throw Error(Code::kBadImage, "this picture is damaged inside; copy or export it again", file);
}

void CheckBmp(std::string_view bytes, const fs::path& file) {
  const std::uint64_t begin = NumberAt(bytes, 10, 4, false);
  const bool is_old = NumberAt(bytes, 14, 4, false) == 12;  // OS/2's head has 16-bit sizes
  const std::uint32_t width = NumberAt(bytes, 18, is_old ? 2 : 4, false);
  const auto rows =
      static_cast<std::int32_t>(NumberAt(bytes, is_old ? 20 : 22, is_old ? 2 : 4, false));
  const std::uint64_t height = static_cast<std::uint64_t>(std::llabs(rows));  // < 0: top row first
  const std::uint64_t bits = NumberAt(bytes, is_old ? 24 : 28, 2, false);
  const std::uint32_t packing = is_old ? 0 : NumberAt(bytes, 30, 4, false);
  RequireSize(width, height, bytes, file);
  if (bits > 32 || begin > bytes.size()) RefuseDamagedPicture(file);
  const bool is_packed = packing == 1 || packing == 2;  // runs of equal pixels
  if (!is_packed && (width * bits + 31) / 32 * 4 * height > bytes.size() - begin)
    RefuseCutOff(file);
}

void CheckPnm(std::string_view bytes, const fs::path& file) {
  const char kind = bytes[1];
  std::string_view left = bytes.substr(2);
  const auto width = TakePnmNumber(left), height = TakePnmNumber(left);
  if (!width || !height) RefuseDamagedPicture(file);
  RequireSize(*width, *height, bytes, file);
  const bool is_bits = kind == '1' || kind == '4';
  const auto largest = is_bits ? std::optional<std::uint64_t>(1) : TakePnmNumber(left);
  if (!largest || *largest == 0 || *largest > 65535) RefuseDamagedPicture(file);
  const std::uint64_t values = *width * *height * (kind == '3' || kind == '6' ? 3 : 1);
  const std::uint64_t bytes_of_rows = kind == '4'      ? (*width + 7) / 8 * *height
                                      : kind == '1'    ? values
                                      : kind < '4'     ? 2 * values - 1  // a digit, a blank
                                      : *largest > 255 ? 2 * values
                                                       : values;
  if (bytes_of_rows > left.size()) RefuseCutOff(file);
}

// The canvas of the extended form, or the one picture of the two simple ones.
void CheckWebp(std::string_view bytes, const fs::path& file) {
  const std::string_view kind = bytes.substr(12, 4);
  std::uint64_t width = 0, height = 0;
  if (kind == "VP8X") {
    width = NumberAt(bytes, 24, 3, false) + 1;
    height = NumberAt(bytes, 27, 3, false) + 1;
  } else if (kind == "VP8L") {
    const std::uint32_t sizes = NumberAt(bytes, 21, 4, false);
    width = (sizes & 0x3fff) + 1;
    height = (sizes >> 14 & 0x3fff) + 1;
  } else {
    width = NumberAt(bytes, 26, 2, false) & 0x3fff;
    height = NumberAt(bytes, 28, 2, false) & 0x3fff;
  }
  RequireSize(width, height, bytes, file);
}

// Bytes of a value of that type, where the type tells them.
std::optional<std::size_t> SizeOfExrValue(std::string_view type) {
  constexpr std::pair<std::string_view, std::size_t> kSizes[] = {
      {"box2f", 16},      {"box2i", 16},   {"chromaticities", 32},
      {"compression", 1}, {"double", 8},   {"envmap", 1},
      {"float", 4},       {"int", 4},      {"keycode", 28},
      {"lineOrder", 1},   {"m33d", 72},    {"m33f", 36},
      {"m44d", 128},      {"m44f", 64},    {"rational", 8},
      {"tiledesc", 9},    {"timecode", 8}, {"v2d", 16},
      {"v2f", 8},         {"v2i", 8},      {"v3d", 24},
      {"v3f", 12},        {"v3i", 12},     {"deepImageState", 1},
  };
  for (const auto& [name, size] : kSizes)
    if (name == type) return size;
  return std::nullopt;
}

// Names with 16 bytes behind each; an empty name ends them.
bool IsExrChannelList(std::string_view value) {
  std::size_t at = 0;
  while (at < value.size() && value[at] != '\0') {
    const std::size_t end = value.find('\0', at);
    if (end == value.npos) return false;
    at = end + 1 + 16;
  }
  return at + 1 == value.size();
}

// OpenEXR reads a value by its type, and what follows from there: a size that is not that of the
// type would make it take what comes next for a head.
bool IsExrValue(std::string_view type, std::string_view value) {
  if (type == "chlist") return IsExrChannelList(value);
  if (type == "preview")
    return value.size() ==
           8 + std::uint64_t{4} * NumberAt(value, 0, 4, false) * NumberAt(value, 4, 4, false);
  if (type == "stringvector") {
    std::size_t at = 0;
    while (at < value.size()) at += 4 + std::size_t{NumberAt(value, at, 4, false)};
    return at == value.size();
  }
  const std::optional<std::size_t> size = SizeOfExrValue(type);
  return !size || *size == value.size();
}

// Attributes one after the other: name, type, size, value; an empty name ends them. OpenEXR takes
// memory for a value before it looks whether the file holds it.
void CheckExr(std::string_view bytes, const fs::path& file) {
  constexpr std::size_t kBegin = 8, kWindow = 16;  // bytes: of magic and version; of a box
  constexpr std::uint32_t kPlain = 0x4ff;          // version, and the flag of long names
  if ((NumberAt(bytes, 4, 4, false) & ~kPlain) != 0)
    throw Error(Code::kBadImage,
                "this EXR has tiles, several parts or samples in depth; save it as one part of "
                "scan lines",
                file);
  std::int64_t width = 0, height = 0;
  std::size_t at = kBegin;
  while (at < bytes.size() && bytes[at] != '\0') {
    const std::string_view name = bytes.substr(at, bytes.find('\0', at) - at);
    constexpr std::size_t kLongestName = 31;  // letters, in files that do not say otherwise
    if (name.size() > kLongestName) RefuseDamagedPicture(file);
    const std::size_t type = std::min(at + name.size() + 1, bytes.size());
    const std::size_t end = bytes.find('\0', type);
    if (end == bytes.npos) RefuseDamagedPicture(file);
    const std::size_t size = NumberAt(bytes, end + 1, 4, false), value = end + 5;
    if (value > bytes.size() || size > bytes.size() - value ||
        !IsExrValue(bytes.substr(type, end - type), bytes.substr(value, size)))
      RefuseDamagedPicture(file);
    if (name == "dataWindow" && size == kWindow) {
      const auto corner = [&](std::size_t i) {
        return std::int64_t{static_cast<std::int32_t>(NumberAt(bytes, value + 4 * i, 4, false))};
      };
      width = corner(2) - corner(0) + 1;
      height = corner(3) - corner(1) + 1;
    }
    at = value + size;
  }
  if (width <= 0 || height <= 0) RefuseDamagedPicture(file);
  RequireSize(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height), bytes, file);
}

void ApplyExifOrientation(std::string_view exif, ColourImage& image) {
  const int orientation = OrientationOf(exif);
  if (orientation < 2 || orientation > 8) return;
  const bool is_transposed = orientation >= 5;
  const bool flips_x = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool flips_y = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  ColourImage upright(is_transposed ? image.height : image.width,
                      is_transposed ? image.width : image.height);
  for (int y = 0; y < upright.height; ++y)
    for (int x = 0; x < upright.width; ++x) {
      int u = flips_x ? upright.width - 1 - x : x, v = flips_y ? upright.height - 1 - y : y;
      if (is_transposed) std::swap(u, v);
      std::copy_n(image.at(u, v), 3, upright.at(x, y));
    }
  image = std::move(upright);
}

}  // namespace arthro
