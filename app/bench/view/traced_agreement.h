// A drawn picture held against the reference tracer, at random pixels of it: where their rays end,
// and in what colour.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "app/view/arthroscopic_view.h"
#include "simulation/scene/scene_io.h"
#include "tests/support/view/reference_tracer.h"

namespace arthro::app {

inline constexpr double kSameDistance = 1e-4;  // m; what is asked of a depth, at some 20 mm
inline constexpr double kSameColour = 8;       // of 255, in the worst channel

struct TracedPixel {
  int x = 0, y = 0;
  double distance = 0;  // m from the tip
  glm::dvec3 colour{0.0};
};

// What `count` pixels of a size x size picture must show: the same ones each time, well inside the
// window, whose rim is blended and bears a mark, and, where they show the backdrop, inside the
// panorama, at whose end the relief ends in a wall. Fewer where a picture has few such.
std::vector<TracedPixel> TracePixels(const LoadedScene& loaded, const Picture& picture, int size,
                                     int count, std::span<const test::ReferenceMesh> meshes = {});

struct TracedAgreement {
  int compared = 0;
  double elsewhere = 0;  // share whose distance is off by more than kSameDistance
  double rms = 0;        // m, of the others
  // Share off by more than kSameColour; NaN where colours are not compared.
  double off_colour = std::numeric_limits<double>::quiet_NaN();
};

// `distances` and, if given, `colours` are a size x size picture's.
TracedAgreement CompareWithTraced(std::span<const TracedPixel> traced,
                                  std::span<const float> distances, int size,
                                  const ColourImage* colours = nullptr);

}  // namespace arthro::app
