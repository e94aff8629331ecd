// Result for a clip: the pose of every frame or why it has none, the portal, the scale, how
// much was measured, and whether the clip determines depth at all. Plain types, so that a window
// can show it. File: relief_io.h.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "authoring/panorama/clip/stage_clock.h"
#include "authoring/relief/joined_scale.h"
#include "simulation/scene/projection.h"

namespace arthro::authoring {

struct PosedFrame {
  int index = 0;  // in the footage
  std::string source;
  bool is_posed = false;
  std::string reason;                 // why it has no pose; "" when it has
  std::array<double, 9> rotation{};   // portal_from_camera, row-major: right, down, view
  std::array<double, 3> centre{};     // the tip, m, portal frame
  double sigma_m = 0, sigma_rad = 0;  // standard deviations; 0: not known
  double head_turn = 0;               // rad, of the camera head on the shaft
  int tracks = 0, inliers = 0;
  double rms_px = 0;
  // Mean distance in the panorama over the relief, between where this frame lays a point of the
  // tissue and where the frames lay it on average; 0 where no panorama was drawn.
  double expected_error_px = 0;
};

// The portal before and from a frame on is not the same.
struct PortalSlide {
  int frame = 0;                  // in the footage
  std::array<double, 3> shift{};  // m
};

// Whether the clip determines depth, and the test that decided it.
struct ReliefVerdict {
  std::string kind = "measured";  // "still", "rotation_only", "texture", "pieces", …
  bool is_measured() const { return kind == "measured"; }
  std::string sentence;  // finding and advice
  std::string test;      // the quantity, with its unit
  double value = 0, limit = 0;
};

struct ReliefReport {
  std::string footage;
  ReliefVerdict verdict;
  std::vector<PosedFrame> frames;
  int points = 0;  // 3-D points behind the poses
  double rms_px = 0;
  // The portal: the origin of all coordinates.
  bool has_pivot = false;
  double shaft_spread = 0;      // rad
  double pivot_miss = 0;        // m, median distance between a shaft and the portal
  double median_insertion = 0;  // m
  double head_turn = 0;         // rad, median
  bool head_wanders = false;    // each frame has its own
  std::vector<PortalSlide> slides;
  double focal_factor = 1;               // best focal length over the given one
  double focal_sigma = 0;                // standard error of the factor; 0: not determined
  bool is_focal_changed = false;         // the lens of the result has that focal length
  std::string scale_source = "assumed";  // or "length", "instrument", "joined"
  double scale = 1;                      // factor that the given lengths applied
  double scale_sigma = 0;                // standard error of the factor's logarithm
  std::vector<ScalePart> scale_parts;    // one per given length
  // Relief h over directions: surface radius = radius - h.
  double radius = 0;  // m
  Projection projection;
  int width = 0, height = 0;
  // Shares of the cells that a frame sees, by origin.
  double measured_share = 0, brightness_share = 0, interpolated_share = 0;
  double coverage = 0;  // share of the cells that three frames see, at or above least_confidence
  // Angle about the mean shaft within which less than half of the cells in view were measured with
  // confidence, rad; an insertion leaves such a hole around its epipole.
  double hole = 0;
  std::array<int, 10> confidence_histogram{};  // cells by tenths of confidence
  std::vector<std::string> warnings;
  std::vector<StageCost> stages;
  double peak_memory_mb = 0;
  std::string options;  // JSON
};

}  // namespace arthro::authoring
