// Tie point: one point of the tissue, clicked in a frame that did not register and in a frame that
// did, or in the panorama. Pixels of the raw pictures, with the origin at the centre of the
// top-left pixel; frames are counted from 0, as in the panorama's report.
#pragma once

#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "simulation/core/options.h"

namespace arthro::authoring {

inline constexpr Range kTiePixel{-0.5, 65535};
inline constexpr Range kTieFrame{0, 1e7};

struct TieInFrame {
  int frame = 0;
  glm::dvec2 pixel{0.0};
  friend bool operator==(const TieInFrame&, const TieInFrame&) = default;
  template <class V>
  void Visit(V&& v) {
    v("frame", frame, Required{kTieFrame}, "", "Number of a frame that is in the panorama.");
    v("pixel", pixel, Required{kTiePixel}, "px", "Pixel of that frame's raw picture.");
  }
};

struct TieInPanorama {
  glm::dvec2 pixel{0.0};
  friend bool operator==(const TieInPanorama&, const TieInPanorama&) = default;
  template <class V>
  void Visit(V&& v) {
    v("pixel", pixel, Required{kTiePixel}, "px",
      "Pixel of the panorama as it is without tied frames.");
  }
};

struct FrameTie {
  int frame = 0;
  glm::dvec2 pixel{0.0};
  std::optional<TieInFrame> other;
  std::optional<TieInPanorama> panorama;
  friend bool operator==(const FrameTie&, const FrameTie&) = default;
  template <class V>
  void Visit(V&& v) {
    v("frame", frame, Required{kTieFrame}, "", "Number of the frame that did not register.");
    v("pixel", pixel, Required{kTiePixel}, "px", "Pixel of its raw picture.");
    v("other", other, Any{}, "", "The same point in another frame.");
    v("panorama", panorama, Any{}, "", "The same point in the panorama.");
  }
};

struct TiesFile {
  std::vector<FrameTie> ties;
  template <class V>
  void Visit(V&& v) {
    v("ties", ties, Required{Any{}}, "", "Pairs of points; each has one partner.");
  }
};

}  // namespace arthro::authoring
