#include "authoring/depth/depth_import.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <mutex>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>

#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/units.h"
#include "simulation/scene/formats/picture_formats.h"
#include "simulation/scene/formats/quiet_error_stream.h"

namespace arthro::authoring {
namespace {

constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 30;  // 16k x 16k floats

// OpenCV reads EXR only where the environment allows it.
void AllowExr() {
  static std::once_flag once;
  std::call_once(once, [] {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): only OpenCV reads it
    ::setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 0);
  });
}

// Empty where it is of another format, or damaged. Only the three decoders that the formats need
// are ever called. Size and soundness are checked first by our own: OpenCV's PNG and TIFF print
// their words on stderr, and give a damaged picture as a whole one.
cv::Mat Decoded(const std::string& bytes, const std::filesystem::path& file) {
  switch (FormatOf(bytes)) {
    case PictureFormat::kPng:
      DecodePng(bytes, file);
      break;
    case PictureFormat::kTiff:
      if (IsFloatTiff(bytes, file))
        DecodeDepthTiff(bytes, "it has several channels, but a depth map has one; save it as grey",
                        file);
      else
        DecodeTiff(bytes, file);
      break;
    case PictureFormat::kExr:
      CheckExr(bytes, file);
      AllowExr();
      break;
    default:
      return {};
  }
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  const QuietErrorStream quiet;
  try {
    return cv::imdecode(
        cv::Mat(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data())),
        cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    return {};
  }
}

}  // namespace

GreyNumbers ReadGreyNumbers(const std::filesystem::path& file) {
  const std::string bytes = ReadWholeFile(file, kMostBytes);
  const cv::Mat image = Decoded(bytes, file);
  if (image.empty())
    throw Error(Code::kBadImage,
                "it could not be read as a depth map; take a PNG or TIFF of 8 or 16 bits, or a "
                "TIFF or EXR of floating point",
                file);
  if (image.channels() != 1)
    throw Error(Code::kBadImage,
                fmt::format("it has {} channels, but a depth map has one; save it as grey",
                            image.channels()),
                file);
  GreyNumbers numbers;
  numbers.width = image.cols;
  numbers.height = image.rows;
  numbers.white = image.depth() == CV_8U ? 255 : image.depth() == CV_16U ? 65535 : 0;
  cv::Mat values;
  image.convertTo(values, CV_32F);
  for (int y = 0; y < values.rows; ++y)
    numbers.values.insert(numbers.values.end(), values.ptr<float>(y),
                          values.ptr<float>(y) + values.cols);
  return numbers;
}

DepthMap ReliefFromNumbers(const GreyNumbers& numbers, const DepthImportOptions& options,
                           double radius, int width, int height,
                           const std::filesystem::path& file) {
  if (numbers.width != width || numbers.height != height)
    throw Error(Code::kBadImage,
                fmt::format("the depth map is {} x {} px, but the panorama is {} x {} px; scale it "
                            "to that size",
                            numbers.width, numbers.height, width, height),
                file);
  DepthMap relief(width, height);
  double nearest = std::numeric_limits<double>::infinity(), furthest = -nearest;
  for (std::size_t i = 0; i < numbers.values.size(); ++i) {
    const double value = static_cast<double>(numbers.values[i]);
    if (!std::isfinite(value) || (options.is_zero_unknown && value == 0)) {
      relief.relief[i] = std::numeric_limits<float>::quiet_NaN();
      continue;
    }
    const double metres = numbers.white > 0
                              ? options.low + value / numbers.white * (options.high - options.low)
                              : value * options.unit;
    const double range = options.meaning == DepthMeaning::kRange ? metres : radius - metres;
    nearest = std::min(nearest, range);
    furthest = std::max(furthest, range);
    relief.relief[i] = static_cast<float>(radius - range);
  }
  if (nearest > furthest)
    throw Error(Code::kBadImage,
                "no pixel of it has a depth; allow 0 as a depth, or take another file", file);
  if (!(nearest > 0) || furthest > 10 * radius)
    throw Error(
        Code::kBadImage,
        fmt::format("with this unit and range the tissue would lie {:.1f} to {:.1f} mm from "
                    "the portal, and the backdrop lies at {:.1f} mm; correct the unit or "
                    "the range",
                    MmFromMetres(nearest), MmFromMetres(furthest), MmFromMetres(radius)),
        file);
  return relief;
}

}  // namespace arthro::authoring
