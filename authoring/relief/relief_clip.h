// The usable frames of a clip as they were filmed, with even light, at the working scale. Unlike
// the panorama's frames they keep the fisheye: tracks and sweep work on rays.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/clip/stage_clock.h"
#include "authoring/panorama/frames/working_frame.h"
#include "authoring/relief/relief_options.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

// One frame of the footage and whether it can be used.
struct ClipRow {
  int index = 0;  // in the footage
  std::string source;
  std::string reason;  // why it is not used; "" when it is
};

struct ReliefClip {
  Lens raw_lens;                     // describes the frames as they were filmed
  Lens lens;                         // describes the working pictures
  double scale = 1;                  // working px per raw px
  std::vector<WorkingFrame> frames;  // usable rows, in order; with the fisheye
  std::vector<cv::Mat> pictures;     // CV_8UC3, RGB, of the frames, without even light
  std::vector<double> tool_shares;   // part of the window that an instrument hides, per frame
  cv::Mat window;                    // CV_8UC1, 255 where the lens shows something
  std::vector<ClipRow> rows;         // all frames of the footage, in order
  std::vector<std::string> warnings;
};

// Stages "read" and "prepare" of the clock. Throws Error where the footage cannot be read, the lens
// is not for its pictures, or fewer than two frames are usable.
ReliefClip ReadReliefClip(const std::filesystem::path& footage, const std::optional<Lens>& lens,
                          const ReliefOptions& options, const std::set<int>& excluded,
                          StageClock& clock);

}  // namespace arthro::authoring
