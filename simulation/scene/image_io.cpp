#include "simulation/scene/image_io.h"

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

namespace arthro {
namespace {

namespace fs = std::filesystem;

// Largest picture that is taken, in pixels: 16k x 16k. More is a broken header or a mistake.
constexpr std::size_t kMaxPixels = std::size_t{1} << 28;

// OpenCV fills what is missing of a truncated file with grey and says nothing, so the end marks of
// the two common formats are looked at here. Trailing bytes after a JPEG's end mark are allowed.
bool IsTruncated(const std::string& bytes) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv))
    return bytes.find("IEND\xae\x42\x60\x82"sv) == bytes.npos;
  if (bytes.starts_with("\xff\xd8"sv)) return bytes.rfind("\xff\xd9"sv) == bytes.npos;
  return false;
}

// OpenCV prints its own words about numbers that it does not take, and a depth map of whole numbers
// is a common slip.
void RefuseNumbersOfATiff(const std::string& bytes, const fs::path& file) {
  using namespace std::string_view_literals;
  if (!bytes.starts_with("II*\0"sv) && !bytes.starts_with("MM\0*"sv)) return;
  TIFFSetErrorHandler(nullptr);
  TIFFSetWarningHandler(nullptr);
  std::istringstream stream(bytes);
  const std::unique_ptr<TIFF, void (*)(TIFF*)> tiff(TIFFStreamOpen("picture", &stream), TIFFClose);
  if (!tiff) return;  // the decoder says so
  std::uint16_t bits = 0, format = 0;
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_SAMPLEFORMAT, &format);
  const bool is_float = format == SAMPLEFORMAT_IEEEFP;
  if (is_float ? bits == 32 : bits <= 16) return;
  throw Error(Code::kBadImage,
              fmt::format("this TIFF holds {} of {} bits; save a picture with 8 or 16 bits and a "
                          "depth map as 32-bit float",
                          is_float ? "floats" : "whole numbers", bits),
              file);
}

cv::Mat Decode(const fs::path& file, int flags) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  std::string bytes;
  try {
    bytes = ReadWholeFile(file);
  } catch (const Error& error) {
    throw Error(Code::kBadImage, error.sentence(), file);
  }
  if (bytes.empty())
    throw Error(Code::kBadImage, "this picture is empty (0 bytes); export it again", file);
  if (IsTruncated(bytes))
    throw Error(Code::kBadImage, "this picture is cut off before its end; copy or export it again",
                file);
  RefuseNumbersOfATiff(bytes, file);
  cv::Mat mat;
  try {
    mat = cv::imdecode(cv::Mat(1, static_cast<int>(bytes.size()), CV_8U, bytes.data()), flags);
  } catch (const cv::Exception&) {
    mat.release();
  }
  if (mat.empty())
    throw Error(Code::kBadImage,
                "this file is not a picture that can be read; use PNG, JPEG or TIFF", file);
  if (mat.total() > kMaxPixels)
    throw Error(Code::kBadImage,
                fmt::format("this picture is {} x {} pixels; at most 16384 x 16384 can be used",
                            mat.cols, mat.rows),
                file);
  return mat;
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

}  // namespace

ColourImage ReadColourImage(const fs::path& file) {
  const cv::Mat bgr = Decode(file, cv::IMREAD_COLOR);
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

void WriteColourImage(const fs::path& file, const ColourImage& image) {
  Encode(file, BgrOf(image), {cv::IMWRITE_JPEG_QUALITY, 95});
}

std::string PngFromColourImage(const ColourImage& image) {
  std::vector<unsigned char> bytes;
  bool encoded = false;
  try {
    encoded = cv::imencode(".png", BgrOf(image), bytes, {cv::IMWRITE_PNG_COMPRESSION, 1});
  } catch (const cv::Exception&) {
    encoded = false;
  }
  if (!encoded) throw Error(Code::kBadImage, "this picture could not be packed as PNG");
  return {bytes.begin(), bytes.end()};
}

DepthMap ReadDepthMap(const fs::path& file) {
  const cv::Mat mat = Decode(file, cv::IMREAD_UNCHANGED);
  if (mat.type() != CV_32FC1)
    throw Error(Code::kBadImage,
                "a depth map must be a one-channel 32-bit float TIFF in metres; make one with "
                "`arthroscene depth`",
                file);
  DepthMap depth(mat.cols, mat.rows);
  for (int y = 0; y < mat.rows; ++y)
    std::memcpy(&depth.at(0, y), mat.ptr<float>(y),
                static_cast<std::size_t>(mat.cols) * sizeof(float));
  return depth;
}

void WriteDepthMap(const fs::path& file, const DepthMap& depth) {
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
  TIFFSetField(tiff.get(), TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  TIFFSetField(tiff.get(), TIFFTAG_PREDICTOR, PREDICTOR_FLOATINGPOINT);
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

}  // namespace arthro
