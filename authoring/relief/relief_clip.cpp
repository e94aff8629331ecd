#include "authoring/relief/relief_clip.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "authoring/footage/footage.h"
#include "authoring/footage/frame_look.h"
#include "authoring/panorama/clip/footage_lens.h"
#include "authoring/panorama/graph/links/parallel.h"
#include "authoring/panorama/preparation/clip_look.h"
#include "authoring/panorama/preparation/frame_masks.h"
#include "authoring/panorama/preparation/prepare.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr double kLargestSide = 640;  // px of a working picture
// The scale under which Prepare finds the reach of its filters, for a picture of 480 px.
constexpr double kFilterScale = 0.6;

// Shows the same rays in pictures of `scale` times the size.
Lens Scaled(const Lens& lens, double scale, const cv::Size& size) {
  const auto moved = [scale](double x) { return (x + 0.5) * scale - 0.5; };
  Lens small = lens;
  small.width = size.width;
  small.height = size.height;
  small.focal_px *= scale;
  small.cx = moved(lens.cx);
  small.cy = moved(lens.cy);
  small.circle = {moved(lens.circle.cx), moved(lens.circle.cy), lens.circle.r * scale};
  return small;
}

// A lens without calibration, over the whole picture: a fisheye where the footage has a round
// window, else a pinhole.
Lens GuessedLens(const FootageLens& found, const FootageInfo& info) {
  constexpr double kFieldOfView = 80;  // degrees; arthroscopes see 70 to 90 across
  Lens lens = found.lens;
  lens.width = info.width;
  lens.height = info.height;
  lens.cx += found.part.x;
  lens.cy += found.part.y;
  if (lens.circle.r <= 0) return lens;
  lens.circle.cx += found.part.x;
  lens.circle.cy += found.part.y;
  lens.model = LensModel::kEquisolid;
  lens.field_of_view = RadiansFromDegrees(kFieldOfView);
  lens.focal_px = lens.circle.r / (2 * std::sin(lens.field_of_view / 4));
  return lens;
}

// 255 where the lens shows something.
cv::Mat WindowOf(const Lens& lens) {
  if (lens.circle.r <= 0) return {lens.height, lens.width, CV_8UC1, cv::Scalar(255)};
  cv::Mat mask(lens.height, lens.width, CV_8UC1, cv::Scalar(0));
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (std::hypot(x - lens.circle.cx, y - lens.circle.cy) < lens.circle.r - 2)
        mask.at<std::uint8_t>(y, x) = 255;
  return mask;
}

}  // namespace

ReliefClip ReadReliefClip(const std::filesystem::path& path, const std::optional<Lens>& lens,
                          const ReliefOptions& options, const std::set<int>& excluded,
                          StageClock& clock) {
  ReliefClip clip;
  const Progress reading = clock.Begin("read");
  Footage footage = Footage::Open(path);
  const FootageInfo info = footage.info();
  FootageLens found = LensOf(footage, lens, reading);
  if (lens) {
    clip.warnings = found.warnings;
  } else {
    found.lens = GuessedLens(found, info);
  }
  clip.scale = std::min(1.0, kLargestSide / std::max(info.width, info.height));
  const cv::Size size(static_cast<int>(std::lround(info.width * clip.scale)),
                      static_cast<int>(std::lround(info.height * clip.scale)));
  clip.raw_lens = found.lens;
  clip.lens = Scaled(found.lens, clip.scale, size);

  // First reading: which frames are worth using.
  FrameLooker looker(found.lens.circle);
  std::vector<FrameLook> looks;
  std::vector<int> odd_sizes;
  cv::Size odd_size;
  cv::Mat raw;
  for (int i = 0;; ++i) {
    reading.Step(fmt::format("reading frame {}", i + 1),
                 i / (info.frames > 0 ? 2.0 * std::max(info.frames, i) : 2.0 * (i + 100)));
    if (!footage.Next(raw)) break;
    ClipRow row{i, footage.NameOf(i), ""};
    FrameLook look;
    if (excluded.contains(i)) {
      row.reason = "left out by hand";
    } else if (raw.empty()) {
      row.reason = "unreadable: " + footage.fault();
    } else if (raw.cols != info.width || raw.rows != info.height) {
      row.reason = fmt::format("it is {} x {} px, the first frame {} x {}", raw.cols, raw.rows,
                               info.width, info.height);
      odd_sizes.push_back(i);
      odd_size = raw.size();
    } else {
      look = looker.Look(raw);
    }
    if (!row.reason.empty()) look.sharpness = -1;
    looks.push_back(look);
    clip.rows.push_back(std::move(row));
  }
  if (!odd_sizes.empty())
    clip.warnings.push_back(fmt::format(
        "frame {} is {} x {} px and the first frame {} x {}; {} left out, give frames of one size",
        odd_sizes.back(), odd_size.width, odd_size.height, info.width, info.height,
        odd_sizes.size() == 1 ? "it was" : fmt::format("{} such frames were", odd_sizes.size())));
  if (options.choose.skip_blank) MarkBlanks(looks);
  const auto reasons = ReasonsAgainst(looks, options.choose);
  std::vector<int> chosen;
  for (std::size_t i = 0; i < clip.rows.size(); ++i) {
    if (clip.rows[i].reason.empty()) clip.rows[i].reason = reasons[i];
    if (clip.rows[i].reason.empty()) chosen.push_back(static_cast<int>(i));
  }
  if (chosen.size() < 2)
    throw Error(Code::kBadImage,
                odd_sizes.empty()
                    ? fmt::format("{} of its {} frames can be used, and a relief needs two views "
                                  "at least; choose other footage",
                                  chosen.size(), clip.rows.size())
                    : clip.warnings.back(),
                path);

  // Second reading: only the chosen ones are kept, and `most_frames` bounds them.
  clip.window = WindowOf(clip.lens);
  if (!lens) {
    // Black bars are no tissue.
    cv::Mat part = cv::Mat::zeros(info.height, info.width, CV_8U);
    part(found.part).setTo(255);
    cv::resize(part, part, size, 0, 0, cv::INTER_NEAREST);
    clip.window &= part;
  }
  ClipLookBuilder builder;
  std::vector<cv::Mat> pictures;
  footage.Rewind();
  for (const int index : chosen) {
    reading.Step("reading the chosen frames", 0.5 + 0.5 * static_cast<double>(pictures.size()) /
                                                        static_cast<double>(chosen.size()));
    while (footage.index() + 1 < index)
      if (!footage.Skip()) break;
    if (!footage.Next(raw) || raw.size() != cv::Size(info.width, info.height))
      throw Error(Code::kBadImage, "the footage changed while it was read; start again", path);
    cv::Mat picture;
    cv::resize(raw, picture, size, 0, 0, cv::INTER_AREA);
    builder.Add(picture, clip.window);
    pictures.push_back(picture);
  }

  const Progress preparing = clock.Begin("prepare");
  const ClipLook look = builder.Finish();
  const double filter_scale = kFilterScale * std::max(size.width, size.height) / 480;
  clip.frames.resize(pictures.size());
  clip.tool_shares.resize(pictures.size());
  const double window = std::max(1, cv::countNonZero(clip.window));
  ForEachIndex(static_cast<int>(pictures.size()), options.threads, preparing,
               "evening out the light", [&](int i) {
                 const auto at = static_cast<std::size_t>(i);
                 clip.frames[at] = Prepare(chosen[at], pictures[at], filter_scale, clip.window,
                                           look, options.prepare);
                 clip.tool_shares[at] =
                     cv::countNonZero(ToolMask(pictures[at], clip.window)) / window;
               });
  clip.pictures = std::move(pictures);
  clock.End();
  return clip;
}

}  // namespace arthro::authoring
