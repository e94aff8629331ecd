#include "authoring/lens/grid/lens_from_pictures.h"

#include <vector>

#include <fmt/format.h>

#include "authoring/footage/find_circle.h"
#include "simulation/core/error.h"
#include "simulation/scene/image_io.h"

namespace arthro::authoring {

PicturesLens LensFromPictures(std::span<const std::filesystem::path> files, double spacing,
                              const DetectOptions& detect, const CalibrateOptions& calibrate,
                              const Progress& progress) {
  const double count = static_cast<double>(files.size());
  std::vector<ColourImage> pictures;
  CircleFinder finder;
  for (const std::filesystem::path& file : files) {
    progress.Step("reading", static_cast<double>(pictures.size()) / count);
    pictures.push_back(ReadColourImage(file));
    ColourImage& picture = pictures.back();
    const ColourImage& first = pictures.front();
    if (picture.width != first.width || picture.height != first.height)
      throw Error(Code::kBadImage,
                  fmt::format("this picture is {} x {} px and {} is {} x {}; a lens is calibrated "
                              "from pictures of one camera at one size",
                              picture.width, picture.height, files.front().string(), first.width,
                              first.height),
                  file);
    finder.Add(cv::Mat(picture.height, picture.width, CV_8UC3, picture.rgb.data()));
  }
  const LensCircle circle = finder.Find().circle;
  std::vector<TargetView> views;
  for (ColourImage& picture : pictures) {
    progress.Step("looking for the target", static_cast<double>(views.size()) / count);
    const cv::Mat rgb(picture.height, picture.width, CV_8UC3, picture.rgb.data());
    views.push_back(DetectTarget(rgb, circle, detect));
  }
  PicturesLens found;
  found.calibration = CalibrateLens(views, {pictures.front().width, pictures.front().height},
                                    circle, spacing, calibrate, progress);
  if (found.calibration.verdict != LensVerdict::kRefused) return found;
  const bool is_one = views.size() == 1 && !views.front().reason.empty();
  found.refusal = is_one ? views.front().reason : found.calibration.sentences.front();
  return found;
}

}  // namespace arthro::authoring
