// The first half of the way from footage to panorama: which frames are usable, and what of them is
// matched. One reading of the clip; a second and third where its pictures would not fit in memory.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/footage/footage.h"
#include "authoring/panorama/footage_lens.h"
#include "authoring/panorama/frames/working_frame.h"
#include "authoring/panorama/panorama_options.h"
#include "authoring/panorama/panorama_report.h"
#include "authoring/panorama/stage_clock.h"

namespace arthro::authoring {

struct PreparedClip {
  FootageInfo info;
  FootageLens lens;
  RectifiedView view;
  double scale = 0.5;                // working px per rectified px
  cv::Mat mask;                      // CV_8UC1, what the lens shows, at the working scale
  std::vector<WorkingFrame> frames;  // of the usable ones, in order
  std::vector<FrameReport> reports;  // of all, in order; the usable ones are not placed yet
  std::vector<std::string> warnings;
};

// Called for each frame as it is read: its row, and a small picture (RGB), empty where none could
// be read.
using FrameObserver = std::function<void(const FrameReport&, const cv::Mat& small_rgb)>;

// The scale at which a view of this size is matched when the options leave it open.
double WorkingScaleOf(const RectifiedView& view);

// Stages "read" and "prepare" of the clock. Throws Error when nothing is usable; see footage.h and
// footage_lens.h for the rest.
PreparedClip PrepareClip(const std::filesystem::path& footage, const std::optional<Lens>& lens,
                         const PanoramaOptions& options, const FrameObserver& observer,
                         StageClock& clock);

}  // namespace arthro::authoring
