// One picture of the arthroscope: pose, lens, instrument and disturbances. Portal frame, m, rad.
#pragma once

#include <numbers>
#include <optional>

#include <glm/vec3.hpp>

#include "app/view/drawing/disturbances.h"
#include "simulation/scene/lens_camera.h"
#include "simulation/scene/scene.h"
#include "simulation/scope/arthroscope.h"
#include "simulation/scope/window_lens.h"
#include "simulation/tissue/contact/tool_shape.h"

namespace arthro::app {

// The instrument as it is drawn: from its portal to the proxy, so that it never enters tissue.
struct InstrumentView {
  glm::dvec3 portal{0.0}, proxy{0.0};  // m
  double roll = 0;                     // γ about its own rod: where the hook points
  simulation::ToolKind kind = simulation::ToolKind::kProbe;
  double opening = 0;  // opening of the jaw, 0 to 1
  double turn = 0;     // angle of the shaver's blade, rad
  friend bool operator==(const InstrumentView&, const InstrumentView&) = default;
};

// How a ray is held against the relief, which then hides what is behind it and moves as the lens
// does. With cells, rays through the corners of cells of pixels are searched, and each pixel closes
// in from there: what is thinner than a cell may be missed. `bench view` prints time and error.
struct ReliefSearch {
  int steps = 0;  // places along a ray, at most; 0: colours lie on the bare sphere
  int cell = 1;   // px; 1: every pixel searches
  friend bool operator==(const ReliefSearch&, const ReliefSearch&) = default;
};
inline constexpr ReliefSearch kUsualRelief{64, 8};

// Features of a picture with a camera, each with all before it: the order in which a slow machine
// leaves them out is from the last. Exposure stays, since it decides how bright the picture is.
enum class CameraFeatures { kExposure, kGrain, kSharpness, kFringe, kEdges, kOcclusion };

// One frame.
struct Picture {
  simulation::ScopeView view;
  double field_of_view = std::numbers::pi / 2;  // full angle
  simulation::WindowLens lens;                  // lens for that field of view
  double notch = 0;  // place of the rim's mark, from image up towards right; γ − κ of the head
  std::optional<InstrumentView> instrument;
  bool plain = false;         // backdrop colours only: no light, softness, mark or models
  Disturbances disturbances;  // over all but a plain picture
  // Share of the most flecks that drift in the fluid (FlecksIn), by the disturbances' seed and
  // time. None in a plain picture.
  double flecks = 0;
  // Camera behind the scope; none: colours as they are lit. Never over a plain picture.
  std::optional<LensCamera> camera;
  CameraFeatures features = CameraFeatures::kOcclusion;
  int rays = 1;  // per pixel and axis, 1 or 2, with a camera
  ReliefSearch relief;
  // Texture samples per pixel, at most: 8 serve footprints eight times as long as wide. 2 are
  // faster, for moving pictures; a fine pattern may then blur or shimmer.
  int samples = 8;
};

// Share of the most flecks that saline usually holds: a few are in sight. The disturbance `debris`
// adds larger pieces.
inline constexpr double kUsualFlecks = 0.25;
inline double FlecksIn(const Backdrop& backdrop) {
  return backdrop.medium == Medium::kSaline ? kUsualFlecks : 0.0;
}

// The camera over footage: its frames have noise of their own, and resampling into the panorama and
// out of it has taken some of their sharpness [method.md, Camera].
inline constexpr double kGrainOverFootage = 0.5, kSharpeningOverFootage = 1.1;
inline LensCamera OverFootage(LensCamera camera) {
  camera.grain *= kGrainOverFootage;
  camera.sharpening *= kSharpeningOverFootage;
  return camera;
}

}  // namespace arthro::app
