// Runs a rendered clip from raw frames to positions, and scores it against its truth.
//
// Frames are drawn at 400 x 320 and treated as half-scale working pictures of an 800 x 640 camera,
// which takes a quarter of the drawing time. Every length, position and error is in the 800 x 640
// pixels of the project's limits. Sensor noise is halved, as averaging four pixels does.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "authoring/footage/frame_look.h"
#include "authoring/lens/rectifier.h"
#include "authoring/panorama/frames/placed_frame.h"
#include "authoring/panorama/graph/register.h"
#include "authoring/phantom/clip/clip.h"
#include "tests/support/panorama/clip_score.h"

namespace arthro::test {

// `frames` of a preset, at the size above.
authoring::ClipOptions CaseOptions(authoring::ClipPreset preset, int frames);

struct CaseRun {
  authoring::RectifiedView view;                // the 800 x 640 camera
  std::vector<authoring::FrameLook> looks;      // every frame of the clip
  std::vector<authoring::FrameResult> results;  // the registered frames
  authoring::RegisterReport report;
  std::vector<cv::Matx33d> truth;  // one per result: rectified to panorama, 800 x 640 px
  std::vector<bool> is_blank;      // one per result
  std::vector<cv::Point2d> nine;   // rectified px
  double cpu_ms = 0;               // processor time of registration

  ClipScore Score(int component = 0) const;
  // Distance of the positions from those of another run of the same frames, px.
  ClipScore Against(const CaseRun& other) const;
  std::vector<std::string> reasons() const;
};

// `believed`: lens that the program assumes for the clip; the truth of a frame is then the
// homography that fits it best. With `has_blanks` blank frames are registered too.
struct CaseSetting {
  std::optional<Lens> believed;
  bool has_blanks = false;
  authoring::RegisterOptions options;
};
CaseRun RunCase(const authoring::Clip& clip, const CaseSetting& setting = {});
CaseRun RunCase(const authoring::ClipOptions& options, const CaseSetting& setting = {});

// Prints the case's numbers in one line and keeps them in the test's record.
void Tell(const std::string& name, const CaseRun& run);

}  // namespace arthro::test
