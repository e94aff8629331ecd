// Agreement of a drawn picture with the reference tracer, at random pixels: end of each ray, and
// its colour.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "app/view/arthroscopic_view.h"
#include "simulation/scene/files/scene_io.h"
#include "tests/support/view/reference_tracer.h"

namespace arthro::app {

inline constexpr double kSameDistance = 1e-4;  // m; required of a depth near 20 mm
inline constexpr double kSameColour = 8;       // in the worst channel, 0 to 255

struct TracedPixel {
  int x = 0, y = 0;
  double distance = 0;  // m from the tip
  glm::dvec3 colour{0.0};
};

// Expected values of `count` pixels of a size x size picture, the same ones in every run. Leaves
// out the window's rim, which is blended and bears a mark, and the panorama's edge, at which the
// relief ends in a wall. Returns fewer where a picture has fewer such pixels.
std::vector<TracedPixel> TracePixels(const LoadedScene& loaded, const Picture& picture, int size,
                                     int count, std::span<const test::ReferenceMesh> meshes = {});

struct TracedAgreement {
  int compared = 0;
  double elsewhere = 0;  // share whose distance is off by more than kSameDistance
  double rms = 0;        // m, over the others
  // Share whose colour is off by more than kSameColour; NaN where colours are not compared.
  double off_colour = std::numeric_limits<double>::quiet_NaN();
};

// Compares the `distances` and, if given, the `colours` of a size x size picture.
TracedAgreement CompareWithTraced(std::span<const TracedPixel> traced,
                                  std::span<const float> distances, int size,
                                  const ColourImage* colours = nullptr);

}  // namespace arthro::app
