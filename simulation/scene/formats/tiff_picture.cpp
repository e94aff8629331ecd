// TIFF through libtiff itself, which OpenCV uses too: so its words stay off stderr, and a strip
// that cannot be unpacked is a fault and not a black band.
#include <algorithm>
#include <memory>
#include <sstream>
#include <string>
#include <tiffio.h>
#include <tiffio.hxx>

#include <fmt/format.h>

#include "simulation/core/error.h"
#include "simulation/scene/formats/picture_formats.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

struct Tiff {
  std::istringstream bytes;
  std::unique_ptr<TIFF, void (*)(TIFF*)> file;
  std::uint32_t width = 0, height = 0;
  std::uint16_t bits = 0, samples = 0, format = 0;

  bool is_float() const { return format == SAMPLEFORMAT_IEEEFP; }
};

std::unique_ptr<Tiff> Open(std::string_view bytes, const fs::path& file) {
  TIFFSetErrorHandler(nullptr);  // each time: OpenCV sets its own where it writes a TIFF
  TIFFSetWarningHandler(nullptr);
  auto tiff =
      std::make_unique<Tiff>(Tiff{std::istringstream(std::string(bytes)), {nullptr, TIFFClose}});
  tiff->file.reset(TIFFStreamOpen("picture", &tiff->bytes));
  if (!tiff->file) RefuseDamagedPicture(file);
  TIFFGetField(tiff->file.get(), TIFFTAG_IMAGEWIDTH, &tiff->width);
  TIFFGetField(tiff->file.get(), TIFFTAG_IMAGELENGTH, &tiff->height);
  TIFFGetFieldDefaulted(tiff->file.get(), TIFFTAG_BITSPERSAMPLE, &tiff->bits);
  TIFFGetFieldDefaulted(tiff->file.get(), TIFFTAG_SAMPLESPERPIXEL, &tiff->samples);
  TIFFGetFieldDefaulted(tiff->file.get(), TIFFTAG_SAMPLEFORMAT, &tiff->format);
  if (tiff->is_float() ? tiff->bits != 32 : tiff->bits > 16)
    throw Error(Code::kBadImage,
                fmt::format("this TIFF holds {} of {} bits; save a picture with 8 or 16 bits and a "
                            "depth map as 32-bit float",
                            tiff->is_float() ? "floats" : "whole numbers", tiff->bits),
                file);
  RequireSize(tiff->width, tiff->height, bytes, file);
  if (TIFFIsTiled(tiff->file.get())) {
    std::uint32_t width = 0, height = 0;
    TIFFGetField(tiff->file.get(), TIFFTAG_TILEWIDTH, &width);
    TIFFGetField(tiff->file.get(), TIFFTAG_TILELENGTH, &height);
    RequireSize(width, height, bytes, file);
  }
  return tiff;
}

void ReadRows(const Tiff& tiff, DepthMap& depth, const fs::path& file) {
  const auto width = static_cast<std::size_t>(depth.width);
  if (TIFFScanlineSize64(tiff.file.get()) != width * sizeof(float)) RefuseDamagedPicture(file);
  depth.relief.reserve(width * static_cast<std::size_t>(depth.height));
  for (std::uint32_t y = 0; y < tiff.height; ++y) {
    depth.relief.resize((y + 1) * width);
    if (TIFFReadScanline(tiff.file.get(), &depth.relief[y * width], y) < 0)
      RefuseDamagedPicture(file);
  }
}

void ReadTiles(const Tiff& tiff, DepthMap& depth, const fs::path& file) {
  std::uint32_t width = 0, height = 0;
  TIFFGetField(tiff.file.get(), TIFFTAG_TILEWIDTH, &width);
  TIFFGetField(tiff.file.get(), TIFFTAG_TILELENGTH, &height);
  const std::size_t size = std::size_t{width} * height;
  if (TIFFTileSize64(tiff.file.get()) != size * sizeof(float)) RefuseDamagedPicture(file);
  const auto tile = std::make_unique_for_overwrite<float[]>(size);
  depth.relief.resize(std::size_t{tiff.width} * tiff.height);
  for (std::uint32_t top = 0; top < tiff.height; top += height)
    for (std::uint32_t left = 0; left < tiff.width; left += width) {
      if (TIFFReadTile(tiff.file.get(), tile.get(), left, top, 0, 0) < 0)
        RefuseDamagedPicture(file);
      const std::uint32_t columns = std::min(width, tiff.width - left);
      for (std::uint32_t y = 0; y < std::min(height, tiff.height - top); ++y)
        std::copy_n(&tile[std::size_t{y} * width], columns,
                    &depth.relief[std::size_t{top + y} * tiff.width + left]);
    }
}

}  // namespace

bool IsFloatTiff(std::string_view bytes, const fs::path& file) {
  return Open(bytes, file)->is_float();
}

ColourImage DecodeTiff(std::string_view bytes, const fs::path& file) {
  const auto tiff = Open(bytes, file);
  char why[1024] = "";
  if (tiff->is_float() || TIFFRGBAImageOK(tiff->file.get(), why) == 0)
    throw Error(Code::kBadImage,
                tiff->is_float()
                    ? "this TIFF holds floats, as a depth map does; give a picture of 8 or 16 bits"
                    : "this TIFF is of a kind that cannot be read; save it as RGB of 8 or 16 bits",
                file);
  const std::size_t pixels = std::size_t{tiff->width} * tiff->height;
  const auto raster = std::make_unique_for_overwrite<std::uint32_t[]>(pixels);
  constexpr int kStopOnFault = 1;
  if (TIFFReadRGBAImageOriented(tiff->file.get(), tiff->width, tiff->height, raster.get(),
                                ORIENTATION_TOPLEFT, kStopOnFault) == 0)
    RefuseDamagedPicture(file);
  ColourImage image(static_cast<int>(tiff->width), static_cast<int>(tiff->height));
  for (std::size_t i = 0; i < pixels; ++i) {
    image.rgb[3 * i] = static_cast<std::uint8_t>(TIFFGetR(raster[i]));
    image.rgb[3 * i + 1] = static_cast<std::uint8_t>(TIFFGetG(raster[i]));
    image.rgb[3 * i + 2] = static_cast<std::uint8_t>(TIFFGetB(raster[i]));
  }
  return image;
}

DepthMap DecodeDepthTiff(std::string_view bytes, const char* expected, const fs::path& file) {
  const auto tiff = Open(bytes, file);
  if (!tiff->is_float() || tiff->samples != 1) throw Error(Code::kBadImage, expected, file);
  DepthMap depth;
  depth.width = static_cast<int>(tiff->width);
  depth.height = static_cast<int>(tiff->height);
  TIFFIsTiled(tiff->file.get()) ? ReadTiles(*tiff, depth, file) : ReadRows(*tiff, depth, file);
  return depth;
}

}  // namespace arthro
