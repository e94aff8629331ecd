// PNG through libpng itself, which OpenCV uses too: only so can its words be kept off stderr and a
// damaged picture be told from a whole one.
#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <png.h>
#include <string>

#include "simulation/scene/formats/picture_formats.h"

namespace arthro {
namespace {

// All that lives across a jump out of libpng.
struct PngReading {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string_view left;
  bool is_damaged = false;
  ColourImage image;
  std::vector<png_bytep> rows;
  std::string exif;

  ~PngReading() { png_destroy_read_struct(&png, &info, nullptr); }
};

void ReadBytes(png_structp png, png_bytep to, std::size_t size) {
  auto& reading = *static_cast<PngReading*>(png_get_io_ptr(png));
  if (size > reading.left.size()) png_error(png, "end");
  std::memcpy(to, reading.left.data(), size);
  reading.left.remove_prefix(size);
}

[[noreturn]] void OnFault(png_structp png, png_const_charp) { png_longjmp(png, 1); }

// A checksum of the pixels that is wrong is only a warning to libpng, and so is a chunk beyond the
// limit, for which it would take memory all the same.
void OnWarning(png_structp png, png_const_charp words) {
  const std::string_view said = words;
  if (said.find("chunk data is too large") != said.npos) png_longjmp(png, 1);
  if (said.starts_with("IDAT:") && said.find("incorrect") != said.npos)
    static_cast<PngReading*>(png_get_error_ptr(png))->is_damaged = true;
}

bool ReadHead(PngReading& reading) {
  if (setjmp(png_jmpbuf(reading.png))) return false;
  png_set_read_fn(reading.png, &reading, ReadBytes);
  png_read_info(reading.png, reading.info);
  return true;
}

void SetTransforms(PngReading& reading) {
  png_set_strip_16(reading.png);
  png_set_strip_alpha(reading.png);
  const int colour = png_get_color_type(reading.png, reading.info);
  if (colour == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(reading.png);
  if (!(colour & PNG_COLOR_MASK_COLOR)) {
    png_set_expand_gray_1_2_4_to_8(reading.png);
    png_set_gray_to_rgb(reading.png);
  }
}

// Rows one by one, so that a file that ends early has not taken the memory of a whole picture.
bool ReadPixels(PngReading& reading) {
  if (setjmp(png_jmpbuf(reading.png))) return false;
  SetTransforms(reading);
  const int passes = png_set_interlace_handling(reading.png);
  png_read_update_info(reading.png, reading.info);
  const std::size_t stride = 3 * static_cast<std::size_t>(reading.image.width);
  if (png_get_rowbytes(reading.png, reading.info) != stride) return false;
  const auto height = static_cast<std::size_t>(reading.image.height);
  reading.image.rgb.reserve(stride * height);
  if (passes > 1) {
    reading.image.rgb.resize(stride * height);
    for (std::size_t y = 0; y < height; ++y) reading.rows.push_back(&reading.image.rgb[y * stride]);
    png_read_image(reading.png, reading.rows.data());
  } else {
    for (std::size_t y = 0; y < height; ++y) {
      reading.image.rgb.resize((y + 1) * stride);
      png_read_row(reading.png, &reading.image.rgb[y * stride], nullptr);
    }
  }
  png_read_end(reading.png, reading.info);
  png_bytep exif = nullptr;
  png_uint_32 size = 0;
  if (png_get_eXIf_1(reading.png, reading.info, &size, &exif) != 0)
    reading.exif.assign(reinterpret_cast<const char*>(exif), size);
  return true;
}

}  // namespace

bool IsGreyPng(std::string_view bytes) {
  constexpr std::size_t kBitDepth = 24, kColourType = 25;  // places in the IHDR chunk
  return bytes.size() > kColourType && bytes[kBitDepth] == 8 &&
         bytes[kColourType] == PNG_COLOR_TYPE_GRAY;
}

ColourImage DecodePng(std::string_view bytes, const std::filesystem::path& file) {
  using namespace std::string_view_literals;
  if (bytes.find("IEND\xae\x42\x60\x82"sv) == bytes.npos) RefuseCutOff(file);
  PngReading reading;
  reading.left = bytes;
  reading.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reading, OnFault, OnWarning);
  if (reading.png) reading.info = png_create_info_struct(reading.png);
  if (!reading.info) throw std::bad_alloc();
  // Debian's libpng takes what a chunk claims before it looks whether the file holds it.
  constexpr std::size_t kUsualChunk = 8'000'000;  // bytes, libpng's own default
  png_set_chunk_malloc_max(reading.png, std::max(kUsualChunk, bytes.size()));
  if (!ReadHead(reading)) RefuseDamagedPicture(file);
  const std::uint32_t width = png_get_image_width(reading.png, reading.info),
                      height = png_get_image_height(reading.png, reading.info);
  RequireSize(width, height, bytes, file);
  reading.image.width = static_cast<int>(width);
  reading.image.height = static_cast<int>(height);
  if (!ReadPixels(reading) || reading.is_damaged) RefuseDamagedPicture(file);
  ApplyExifOrientation(reading.exif, reading.image);
  return std::move(reading.image);
}

}  // namespace arthro
