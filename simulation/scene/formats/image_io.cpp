#include "simulation/scene/image_io.h"

#include <cmath>
#include <cstring>
#include <memory>
#include <sstream>
#include <tiffio.h>
#include <tiffio.hxx>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/formats/picture_formats.h"
#include "simulation/scene/formats/quiet_error_stream.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

// A joint is centimetres wide; more are millimetres that are called metres, or a broken file.
constexpr float kMostRelief = 10;  // m; a map in millimetres by mistake is warned of by `check`

std::string BytesOf(const fs::path& file) {
  std::string bytes;
  try {
    bytes = ReadWholeFile(file);
  } catch (const Error& error) {
    throw Error(Code::kBadImage, error.sentence(), file);
  }
  if (bytes.empty())
    throw Error(Code::kBadImage, "this picture is empty (0 bytes); export it again", file);
  return bytes;
}

// The formats that are rarely used. `bytes` have a head that was checked.
ColourImage DecodeWithOpenCv(const std::string& bytes, const fs::path& file) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  const QuietErrorStream quiet;
  cv::Mat bgr;
  try {
    bgr = cv::imdecode(
        cv::Mat(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data())),
        cv::IMREAD_COLOR);
  } catch (const cv::Exception&) {
    bgr.release();
  }
  if (bgr.empty()) RefuseDamagedPicture(file);
  ColourImage image(bgr.cols, bgr.rows);
  for (int y = 0; y < bgr.rows; ++y) {
    const unsigned char* from = bgr.ptr<unsigned char>(y);
    std::uint8_t* to = image.at(0, y);
    for (int x = 0; x < bgr.cols; ++x, from += 3, to += 3) {
      to[0] = from[2];
      to[1] = from[1];
      to[2] = from[0];
    }
  }
  return image;
}

cv::Mat BgrOf(const ColourImage& image) {
  cv::Mat bgr(image.height, image.width, CV_8UC3);
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* from = image.at(0, y);
    unsigned char* to = bgr.ptr<unsigned char>(y);
    for (int x = 0; x < image.width; ++x, from += 3, to += 3) {
      to[0] = from[2];
      to[1] = from[1];
      to[2] = from[0];
    }
  }
  return bgr;
}

void Encode(const fs::path& file, const cv::Mat& mat, const std::vector<int>& parameters) {
  std::vector<unsigned char> bytes;
  bool encoded = false;
  const std::string extension = file == "-" ? ".png" : file.extension().string();
  try {
    encoded = cv::imencode(extension, mat, bytes, parameters);
  } catch (const cv::Exception&) {
    encoded = false;
  }
  if (!encoded)
    throw Error(
        Code::kBadArgument,
        fmt::format("\"{}\" is not a picture format that can be written; use .png, .jpg or .tiff",
                    extension),
        file);
  WriteAtomically(file,
                  std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

std::string Packed(const ColourImage& image, const char* extension,
                   const std::vector<int>& parameters) {
  std::vector<unsigned char> bytes;
  bool encoded = false;
  try {
    encoded = cv::imencode(extension, BgrOf(image), bytes, parameters);
  } catch (const cv::Exception&) {
    encoded = false;
  }
  if (!encoded)
    throw Error(Code::kBadImage, fmt::format("this picture could not be packed as {}", extension));
  return {bytes.begin(), bytes.end()};
}

void RequireSizeOfDepth(const DepthMap& depth, const char* what, int width, int height,
                        const fs::path& file) {
  if (depth.width == width && depth.height == height) return;
  throw Error(Code::kBadScene,
              fmt::format("{} is {} x {} but the depth map is {} x {}; make both with "
                          "`arthroscene relief`",
                          what, width, height, depth.width, depth.height),
              file);
}

}  // namespace

ColourImage ReadColourImage(const fs::path& file) {
  const std::string bytes = BytesOf(file);
  switch (FormatOf(bytes)) {
    case PictureFormat::kPng:
      return DecodePng(bytes, file);
    case PictureFormat::kJpeg:
      return DecodeJpeg(bytes, file);
    case PictureFormat::kTiff:
      return DecodeTiff(bytes, file);
    case PictureFormat::kBmp:
      CheckBmp(bytes, file);
      return DecodeWithOpenCv(bytes, file);
    case PictureFormat::kPnm:
      CheckPnm(bytes, file);
      return DecodeWithOpenCv(bytes, file);
    case PictureFormat::kWebp:
      CheckWebp(bytes, file);
      return DecodeWithOpenCv(bytes, file);
    case PictureFormat::kExr:
    case PictureFormat::kUnknown:
      break;
  }
  throw Error(Code::kBadImage, "this file is not a picture that can be read; use PNG, JPEG or TIFF",
              file);
}

void WriteColourImage(const fs::path& file, const ColourImage& image) {
  Encode(file, BgrOf(image), {cv::IMWRITE_JPEG_QUALITY, 95});
}

std::string PngFromColourImage(const ColourImage& image) {
  return Packed(image, ".png", {cv::IMWRITE_PNG_COMPRESSION, 1});
}

std::string JpegFromColourImage(const ColourImage& image, int quality) {
  return Packed(image, ".jpg", {cv::IMWRITE_JPEG_QUALITY, quality});
}

DepthMap ReadDepthMap(const fs::path& file) {
  const std::string bytes = BytesOf(file);
  constexpr const char* kExpected =
      "a depth map must be a one-channel 32-bit float TIFF in metres; make one with "
      "`arthroscene depth`";
  const PictureFormat format = FormatOf(bytes);
  if (format == PictureFormat::kUnknown || format == PictureFormat::kExr)
    throw Error(Code::kBadImage,
                "this file is not a picture that can be read; a depth map is a one-channel 32-bit "
                "float TIFF",
                file);
  if (format != PictureFormat::kTiff) throw Error(Code::kBadImage, kExpected, file);
  DepthMap depth = DecodeDepthTiff(bytes, kExpected, file);
  for (std::size_t i = 0; i < depth.relief.size(); ++i) {
    if (std::isnan(depth.relief[i]) || std::abs(depth.relief[i]) <= kMostRelief) continue;
    const auto width = static_cast<std::size_t>(depth.width);
    throw Error(Code::kBadImage,
                fmt::format("the depth at column {}, row {} is {:g} m, and no joint is that deep; "
                            "depths are in metres, and NaN where nothing was imaged",
                            i % width, i / width, depth.relief[i]),
                file);
  }
  return depth;
}

void WriteDepthMap(const fs::path& file, const DepthMap& depth, DepthPacking packing) {
  if (file != "-" && file.extension() != ".tiff" && file.extension() != ".tif")
    throw Error(Code::kBadArgument, "a depth map is written as a float TIFF; name it .tiff", file);
  if (depth.empty()) throw Error(Code::kBadArgument, "an empty depth map cannot be written", file);
  // OpenCV writes float TIFFs uncompressed, so libtiff does it: deflate behind the predictor for
  // floats.
  std::ostringstream bytes;
  std::unique_ptr<TIFF, void (*)(TIFF*)> tiff(TIFFStreamOpen("depth", &bytes), TIFFClose);
  if (!tiff)
    throw Error(Code::kFile, "could not be packed as TIFF; there is too little memory for it",
                file);
  TIFFSetField(tiff.get(), TIFFTAG_IMAGEWIDTH, depth.width);
  TIFFSetField(tiff.get(), TIFFTAG_IMAGELENGTH, depth.height);
  TIFFSetField(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(tiff.get(), TIFFTAG_BITSPERSAMPLE, 32);
  TIFFSetField(tiff.get(), TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
  TIFFSetField(tiff.get(), TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  if (packing == DepthPacking::kQuick) {
    TIFFSetField(tiff.get(), TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  } else {
    TIFFSetField(tiff.get(), TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
    TIFFSetField(tiff.get(), TIFFTAG_PREDICTOR, PREDICTOR_FLOATINGPOINT);
  }
  constexpr int kRowsPerStrip = 64;
  TIFFSetField(tiff.get(), TIFFTAG_ROWSPERSTRIP, kRowsPerStrip);
  std::vector<float> row(static_cast<std::size_t>(depth.width));  // the predictor works in place
  for (int y = 0; y < depth.height; ++y) {
    std::memcpy(row.data(), &depth.relief[static_cast<std::size_t>(y) * depth.width],
                row.size() * sizeof(float));
    if (TIFFWriteScanline(tiff.get(), row.data(), static_cast<std::uint32_t>(y)) < 0)
      throw Error(Code::kFile, "could not be packed as TIFF; there is too little memory for it",
                  file);
  }
  tiff.reset();  // writes the directory
  WriteAtomically(file, bytes.str());
}

DepthMap ReadDepthSigma(const fs::path& file) {
  const std::string bytes = BytesOf(file);
  constexpr const char* kExpected =
      "the standard error of a depth map must be a one-channel 32-bit float TIFF in metres; make "
      "both with `arthroscene relief`";
  if (FormatOf(bytes) != PictureFormat::kTiff) throw Error(Code::kBadImage, kExpected, file);
  DepthMap sigma = DecodeDepthTiff(bytes, kExpected, file);
  for (std::size_t i = 0; i < sigma.relief.size(); ++i) {
    const float value = sigma.relief[i];
    if (std::isnan(value) || (value >= 0.0f && value <= kMostRelief)) continue;
    const auto width = static_cast<std::size_t>(sigma.width);
    throw Error(Code::kBadImage,
                fmt::format("the standard error at column {}, row {} is {:g} m; it must be between "
                            "0 and {:g} m, or NaN where it is not known",
                            i % width, i / width, value, kMostRelief),
                file);
  }
  return sigma;
}

OriginMap ReadOriginMap(const fs::path& file) {
  const std::string bytes = BytesOf(file);
  if (FormatOf(bytes) != PictureFormat::kPng || !IsGreyPng(bytes))
    throw Error(Code::kBadImage,
                "the origins of a depth map must be a one-channel 8-bit PNG with the numbers 0 to "
                "3; make both with `arthroscene relief`",
                file);
  const ColourImage grey = DecodePng(bytes, file);
  OriginMap origins(grey.width, grey.height);
  for (std::size_t i = 0; i < origins.origin.size(); ++i) {
    const std::uint8_t value = grey.rgb[3 * i];
    if (value > static_cast<std::uint8_t>(kLastReliefOrigin)) {
      const auto width = static_cast<std::size_t>(grey.width);
      throw Error(Code::kBadImage,
                  fmt::format("the origin at column {}, row {} is {}; it must be 0 (none), 1 "
                              "(measured), 2 (brightness) or 3 (interpolated)",
                              i % width, i / width, value),
                  file);
    }
    origins.origin[i] = static_cast<ReliefOrigin>(value);
  }
  return origins;
}

void WriteOriginMap(const fs::path& file, const OriginMap& origins) {
  if (file != "-" && file.extension() != ".png")
    throw Error(Code::kBadArgument,
                "the origins of a depth map are written as a PNG; name the file .png", file);
  if (origins.empty())
    throw Error(Code::kBadArgument, "an empty map of origins cannot be written", file);
  Encode(file,
         cv::Mat(origins.height, origins.width, CV_8UC1,
                 const_cast<ReliefOrigin*>(origins.origin.data())),
         {});
}

void RequireSameSize(const ColourImage& panorama, const DepthMap& depth,
                     const fs::path& depth_file) {
  if (depth.width == panorama.width && depth.height == panorama.height) return;
  throw Error(
      Code::kBadScene,
      fmt::format("the depth map is {} x {} but the panorama is {} x {}; make it again with "
                  "`arthroscene depth`",
                  depth.width, depth.height, panorama.width, panorama.height),
      depth_file);
}

void RequireSameSize(const DepthMap& depth, const DepthMap& sigma, const fs::path& sigma_file) {
  RequireSizeOfDepth(depth, "the standard error", sigma.width, sigma.height, sigma_file);
}

void RequireSameSize(const DepthMap& depth, const OriginMap& origins, const fs::path& origin_file) {
  RequireSizeOfDepth(depth, "the map of origins", origins.width, origins.height, origin_file);
}

}  // namespace arthro
