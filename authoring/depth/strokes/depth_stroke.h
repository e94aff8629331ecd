// A stroke of a brush by which an author mends a depth map. It is data: it is stored with the
// scene, and applied again when the map is made anew. Points and radius are shares of the
// panorama's width, so that they keep their place at any resolution; points count from the top left
// corner of the picture. Heights in m.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "simulation/core/options.h"

namespace arthro::authoring {

enum class StrokeKind {
  kRaise,       // towards the scope, by `amount`
  kLower,       // away from it
  kSmooth,      // mean over half the radius
  kFlatten,     // plane through the surface under the stroke
  kBrightness,  // shape of the brightness, `amount` from black to white, at the mean height
  kUnknown,     // no depth: no touch, no parallax
  kEdge,        // a step along the line, between the heights at both rims
  kMask,        // glint or instrument: its depth is filled from the surround
  kKeep,        // tissue, although it looks like a glint; takes a mask away
};

// Fall of the weight from the hard core to the rim.
enum class StrokeFalloff { kSmooth, kLinear, kRound };

inline constexpr double kHighestStroke = 0.05;  // m

struct DepthStroke {
  StrokeKind kind = StrokeKind::kRaise;
  double radius = 0.01;
  double hardness = 0.5;
  StrokeFalloff falloff = StrokeFalloff::kSmooth;
  double amount = 1e-3;
  double strength = 1.0;
  std::vector<glm::dvec2> points;
  friend bool operator==(const DepthStroke&, const DepthStroke&) = default;

  // All fields but the points.
  template <class V>
  void Visit(V&& v) {
    v("kind", kind,
      Choices<StrokeKind>{{{StrokeKind::kRaise, "raise"},
                           {StrokeKind::kLower, "lower"},
                           {StrokeKind::kSmooth, "smooth"},
                           {StrokeKind::kFlatten, "flatten"},
                           {StrokeKind::kBrightness, "brightness"},
                           {StrokeKind::kUnknown, "unknown"},
                           {StrokeKind::kEdge, "edge"},
                           {StrokeKind::kMask, "mask"},
                           {StrokeKind::kKeep, "keep"}}},
      "", "Effect of the stroke on the relief.");
    v("radius", radius, Range{0, 1, true}, "", "Radius as a share of the panorama's width.");
    v("hardness", hardness, Range{0, 1}, "",
      "Share of the radius within which the stroke has its full weight.");
    v("falloff", falloff,
      Choices<StrokeFalloff>{{{StrokeFalloff::kSmooth, "smooth"},
                              {StrokeFalloff::kLinear, "linear"},
                              {StrokeFalloff::kRound, "round"}}},
      "", "Fall of the weight from the hard core to the rim.");
    v("amount", amount, Range{0, kHighestStroke}, "m",
      "Height by which the stroke raises or lowers, or from black to white for brightness.");
    v("strength", strength, Range{0, 1}, "",
      "Share of the way to the new height, for smooth, flatten, brightness and edge.");
  }
};

using DepthStrokes = std::vector<DepthStroke>;
// Strokes of a document, in the order in which they were drawn; null: none.
using SharedStrokes = std::shared_ptr<const DepthStrokes>;

// Weight at the distance `share` of the radius from the line: 1 up to the hardness, 0 from 1 on.
double StrokeWeight(const DepthStroke& stroke, double share);

// The strokes with another one at their end.
SharedStrokes WithStroke(const SharedStrokes& strokes, DepthStroke stroke);

// Whether the stroke changes what the estimator sees, not the relief that it has made.
bool IsMask(const DepthStroke& stroke);

const char* ToString(StrokeKind kind);

}  // namespace arthro::authoring
