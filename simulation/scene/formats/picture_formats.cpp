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
  if (bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6' &&
      std::isspace(bytes[2] & 0xff))
    return PictureFormat::kPnm;
  return PictureFormat::kUnknown;
}

void RequireSize(std::uint64_t width, std::uint64_t height, const fs::path& file) {
  if (width == 0 || height == 0) RefuseDamagedPicture(file);
  if (width <= kMaxPixels / height) return;
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
  RequireSize(width, height, file);
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
  RequireSize(*width, *height, file);
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
