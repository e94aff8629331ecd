// First half of the path from footage to panorama: selects the usable frames and prepares them for
// matching. Reads the clip once, or up to three times when its pictures do not fit in memory.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/footage/footage.h"
#include "authoring/lens/rectifier.h"
#include "authoring/panorama/clip/footage_lens.h"
#include "authoring/panorama/clip/panorama_options.h"
#include "authoring/panorama/clip/panorama_report.h"
#include "authoring/panorama/clip/stage_clock.h"
#include "authoring/panorama/frames/working_frame.h"

namespace arthro::authoring {

struct PreparedClip {
  FootageInfo info;
  FootageLens lens;
  RectifiedView view;
  double scale = 0.5;                // working px per rectified px
  cv::Mat mask;                      // CV_8UC1, visible area of the lens at the working scale
  std::vector<WorkingFrame> frames;  // usable frames, in order
  std::vector<FrameReport> reports;  // all frames, in order; the usable ones are not placed yet
  std::vector<PixelBox> text_boxes;  // a proposal of what to mask (text_boxes.h)
  std::vector<std::string> warnings;
};

// Called for each frame as it is read, with its row and a small picture (RGB), empty for an
// unreadable frame.
using FrameObserver = std::function<void(const FrameReport&, const cv::Mat& small_rgb)>;

// Scale of matching for a view of this size, when the options leave it open.
double WorkingScaleOf(const RectifiedView& view);

// Runs the stages "read" and "prepare" of the clock. Throws Error when no frame is usable; see
// footage.h and footage_lens.h for other errors.
// `masked`: of the raw pictures.
PreparedClip PrepareClip(const Clips& clips, const std::optional<Lens>& lens,
                         const std::vector<PixelBox>& masked, const PanoramaOptions& options,
                         const FrameObserver& observer, StageClock& clock);

}  // namespace arthro::authoring
