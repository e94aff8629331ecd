// A rendered clip through the whole way from raw frames to places, scored against its truth.
//
// Frames are drawn at 400 x 320 and told to be the half-scale working pictures of an 800 x 640
// camera: a quarter of the drawing, and every length, place and error is in the 800 x 640 pixels
// that the project's limits are stated in. Sensor noise is halved, as averaging four pixels does.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "authoring/footage/frame_look.h"
#include "authoring/lens/rectifier.h"
#include "authoring/panorama/frames/placed_frame.h"
#include "authoring/panorama/graph/register.h"
#include "authoring/phantom/clip/clip.h"
#include "authoring/phantom/clip/clip_score.h"

namespace arthro::test {

// `frames` of a preset, at the size above.
authoring::ClipOptions CaseOptions(authoring::ClipPreset preset, int frames);

struct CaseRun {
  authoring::RectifiedView view;                // of the 800 x 640 camera
  std::vector<authoring::FrameLook> looks;      // of every frame of the clip
  std::vector<authoring::FrameResult> results;  // of the frames that are registered
  authoring::RegisterReport report;
  std::vector<cv::Matx33d> truth;  // of the results: rectified to panorama, 800 x 640 px
  std::vector<bool> is_blank;      // of the results
  std::vector<cv::Point2d> nine;   // rectified px
  double cpu_ms = 0;               // of registration

  authoring::ClipScore Score(int component = 0) const;
  // How far the places are from those of another run of the same frames, px.
  authoring::ClipScore Against(const CaseRun& other) const;
  std::vector<std::string> reasons() const;
};

// With `believed`, the lens that the program takes for the clip's; the truth of a frame is then the
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
