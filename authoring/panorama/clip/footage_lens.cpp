#include "authoring/panorama/clip/footage_lens.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "authoring/footage/find_circle.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr const char* kStage = "finding the round window";

// Reads about `count` frames, spread over the clip.
ClipCircle CircleOf(Footage& footage, int count, const Progress& progress) {
  constexpr int kUnknownLength = 250;  // frames; used when the container does not give a length
  const int frames = footage.info().frames > 0 ? footage.info().frames : kUnknownLength;
  const int stride = std::max(1, frames / count);
  CircleFinder finder;
  cv::Mat rgb;
  const cv::Size size(footage.info().width, footage.info().height);
  for (int i = 0; i < frames; ++i) {
    progress.Step(kStage, static_cast<double>(i) / frames);
    if (i % stride != stride / 2) {
      if (!footage.Skip()) break;
      continue;
    }
    if (!footage.Next(rgb)) break;
    if (rgb.size() == size) finder.Add(rgb);
  }
  footage.Rewind();
  return finder.Find();
}

// Lens without calibration: only the picture's width hints at the field of view.
Lens GuessedLens(const cv::Size& size, const LensCircle& circle) {
  constexpr double kHalfField = 37.5;  // degrees; arthroscopes see 70 to 80 across
  Lens lens;
  lens.model = LensModel::kPinhole;
  lens.width = size.width;
  lens.height = size.height;
  // Integer centre, so that the rectified picture has exactly the pixels of the raw one.
  lens.cx = std::round(circle.r > 0 ? circle.cx : 0.5 * (size.width - 1));
  lens.cy = std::round(circle.r > 0 ? circle.cy : 0.5 * (size.height - 1));
  lens.cx = std::clamp(lens.cx, 0.0, size.width - 1.0);
  lens.cy = std::clamp(lens.cy, 0.0, size.height - 1.0);
  const double radius = circle.r > 0 ? circle.r : 0.5 * std::hypot(size.width, size.height);
  lens.focal_px = radius / std::tan(RadiansFromDegrees(kHalfField));
  lens.field_of_view = RadiansFromDegrees(2 * kHalfField);
  lens.circle = circle;
  return lens;
}

}  // namespace

FootageLens LensOf(Footage& footage, const std::optional<Lens>& given, const Progress& progress) {
  constexpr int kFramesToFind = 12, kFramesToCheck = 3;
  const FootageInfo& info = footage.info();
  FootageLens found;
  found.part = cv::Rect(0, 0, info.width, info.height);
  if (given && (given->width != info.width || given->height != info.height))
    throw Error(
        Code::kBadArgument,
        fmt::format("the lens was calibrated for pictures of {} x {} px but those of {} are "
                    "{} x {}; take the lens of this camera at this size, or none",
                    given->width, given->height, info.name, info.width, info.height));
  if (!given) {
    const ClipCircle circle = CircleOf(footage, kFramesToFind, progress);
    // Black bars are no tissue, and their edge is no edge of tissue.
    constexpr int kLeastPart = 32;  // px per side
    if (circle.lit.width >= kLeastPart && circle.lit.height >= kLeastPart) found.part = circle.lit;
    LensCircle window = circle.circle;
    window.cx -= found.part.x;
    window.cy -= found.part.y;
    found.lens = GuessedLens(found.part.size(), window);
    found.is_guessed = true;
    found.wanders = circle.wanders;
    found.warnings.push_back(
        fmt::format("no lens was given: the pictures are not rectified, and the focal length of "
                    "{:.0f} px is a guess",
                    found.lens.focal_px));
  } else {
    found.lens = *given;
    const bool has_circle = given->circle.r > 0;
    const ClipCircle circle =
        CircleOf(footage, has_circle ? kFramesToCheck : kFramesToFind, progress);
    found.wanders = circle.wanders;
    if (circle.circle.r > 0) {
      const LensCircle &ours = circle.circle, &theirs = given->circle;
      constexpr double kAgree =
          0.03;  // share of the radius; equals the margin that is excluded at the rim
      const double off = std::max(std::hypot(ours.cx - theirs.cx, ours.cy - theirs.cy),
                                  std::abs(ours.r - theirs.r));
      if (!has_circle) {
        found.lens.circle = ours;
      } else if (off > kAgree * theirs.r) {
        found.lens.circle = ours;
        found.warnings.push_back(fmt::format(
            "the lens has a round window of radius {:.0f} px at ({:.0f}, {:.0f}), the footage one "
            "of {:.0f} px at ({:.0f}, {:.0f}): is it the lens of this camera?",
            theirs.r, theirs.cx, theirs.cy, ours.r, ours.cx, ours.cy));
      }
    }
  }
  constexpr double kStill = 2.0;  // px
  if (found.wanders > kStill)
    found.warnings.push_back(fmt::format(
        "the round window moves by {:.0f} px over the clip; only what every frame shows "
        "is used",
        found.wanders));
  return found;
}

}  // namespace arthro::authoring
