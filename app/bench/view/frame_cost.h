// Cost of each feature of a moving picture. The pictures are a chain: each has the features of
// those before it and one more, in the order in which a machine can leave them out from the end
// (app/editor/pictures/render_scale.h). All of them are drawn in turns, so that a change of the
// machine's speed falls on all; the share of a feature is the median of its differences within a
// turn. Only the times differ between runs on one renderer.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/bench/view/frame_times.h"
#include "simulation/core/progress.h"

namespace arthro::app {

struct FrameCostRow {
  std::string words;   // "grain"
  int size = 0;        // px
  FrameTimes picture;  // times of the whole picture
  FrameTimes share;    // times of the feature
  // Share of random pixels whose ray ends elsewhere than the ray tracer's; for features that change
  // distances.
  std::optional<double> ends_off = {};
  // Root mean square difference from the same picture at rest, of 255; for features of the camera.
  std::optional<double> off_still = {};
};

struct FrameCostOptions {
  int timed_frames = 60, panorama = 4096, triangles = 20000, pixels = 3000;
};

// An OpenGL context must be current. One chain per size.
std::vector<FrameCostRow> MeasureFrameCosts(const FrameCostOptions& options,
                                            const std::vector<int>& sizes,
                                            const Progress& progress);

std::string TableOf(const std::vector<FrameCostRow>& rows);
nlohmann::json JsonOf(const std::vector<FrameCostRow>& rows);

}  // namespace arthro::app
