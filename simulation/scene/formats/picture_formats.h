// Pictures from the bytes of a whole file. Size and kind of numbers are read from the head and
// held against kMaxPixels before pixels are decoded, and a picture that is damaged inside is
// refused: decoders would say their own words on stderr and leave the rest grey.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "simulation/scene/image.h"

namespace arthro {

// Largest picture that is taken: 16k x 16k. More is a broken head or a mistake.
inline constexpr std::size_t kMaxPixels = std::size_t{1} << 28;

// A larger picture than this needs a byte of its file for so many pixels. A flat picture is packed
// more densely, but a file of less than 1 MB must not cost 1 GB of memory or seconds of unpacking.
inline constexpr std::size_t kMostFreePixels = std::size_t{1} << 26, kMostPixelsPerByte = 64;

enum class PictureFormat { kUnknown, kPng, kJpeg, kTiff, kBmp, kWebp, kPnm, kExr };

// Judged by the first bytes, never by the name.
PictureFormat FormatOf(std::string_view bytes);

// All below throw Error(kBadImage); `file` is for the sentence only.
// `bytes`: the whole file.
void RequireSize(std::uint64_t width, std::uint64_t height, std::string_view bytes,
                 const std::filesystem::path& file);
[[noreturn]] void RefuseCutOff(const std::filesystem::path& file);
[[noreturn]] void RefuseDamagedPicture(const std::filesystem::path& file);

// 8-bit RGB: grey is spread, 16 bit scaled down, alpha dropped, EXIF orientation applied.
ColourImage DecodePng(std::string_view bytes, const std::filesystem::path& file);
ColourImage DecodeJpeg(std::string_view bytes, const std::filesystem::path& file);
ColourImage DecodeTiff(std::string_view bytes, const std::filesystem::path& file);
// One channel of 32-bit floats; `expected` is the sentence that refuses another TIFF.
DepthMap DecodeDepthTiff(std::string_view bytes, const char* expected,
                         const std::filesystem::path& file);
bool IsFloatTiff(std::string_view bytes, const std::filesystem::path& file);
// Does the head of a PNG say one channel of 8 bits, without a palette?
bool IsGreyPng(std::string_view bytes);

// Only the head of what OpenCV decodes: size, and bytes enough for it.
void CheckBmp(std::string_view bytes, const std::filesystem::path& file);
void CheckPnm(std::string_view bytes, const std::filesystem::path& file);
void CheckWebp(std::string_view bytes, const std::filesystem::path& file);
void CheckExr(std::string_view bytes, const std::filesystem::path& file);

// Turns the picture upright by the orientation (1 to 8) that EXIF data holds, or leaves it.
void ApplyExifOrientation(std::string_view exif, ColourImage& image);

}  // namespace arthro
