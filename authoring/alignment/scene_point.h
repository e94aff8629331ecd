// A place of the scene that a person clicked in a picture: where the line of sight meets the relief
// of the backdrop, and how certain that is. Portal frame, m, rad.
#pragma once

#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/files/loaded_scene.h"
#include "simulation/scene/relief_origin.h"
#include "simulation/scope/window_lens.h"

namespace arthro::authoring {

struct ScenePoint {
  glm::dvec3 x_in_portal{0.0};  // m
  glm::dvec3 eye{0.0};          // m; centre of the picture in which it was clicked
  // Scale of that picture around the place; 0: the place was given by coordinates.
  double px_per_radian = 0;
  // Standard errors across the line from the eye and along it, m.
  double lateral_sigma = 0, range_sigma = 0;
  bool is_guessed = false;  // its range was not measured
  friend bool operator==(const ScenePoint&, const ScenePoint&) = default;
};

// Standard error of a click, px.
inline constexpr double kClickSigma = 2.0;

// Line of sight of a picture: unit direction, and scale of the picture around it.
struct Sight {
  glm::dvec3 eye{0.0}, direction{0, 0, 1};
  double px_per_radian = 0;
};

// Line through a pixel of the panorama.
Sight SightOfPanorama(const Backdrop& backdrop, const glm::dvec2& pixel);
// Line through a pixel of the scope's round picture of size x size pixels; nothing outside it.
std::optional<Sight> SightOfScope(const simulation::ScopeOptics& optics,
                                  const simulation::ScopeView& view, int size,
                                  const glm::dvec2& pixel);

// Point at which the line meets the relief; nothing where it leaves the scene through a place that
// nothing has imaged. The standard error of the range is that of the relief, where the scene has
// one, together with the change of the range within the standard error of the click.
// `unstated`: origin of the depths where the scene has no map of their origins. It matters for the
// error only: the noise that a relief from brightness states is below its error.
std::optional<ScenePoint> PointOnRelief(const LoadedScene& scene, const Sight& sight,
                                        ReliefOrigin unstated = ReliefOrigin::kMeasured);

// Refusal of a landmark on a hole; a whole sentence.
inline constexpr const char* kNothingImaged =
    "Nothing was imaged there, so its distance is not known; click where the picture shows tissue.";

// Residual of a point of the model in the picture in which `point` was clicked, px; nothing for a
// point that was given by coordinates.
std::optional<double> ResidualPx(const ScenePoint& point, const glm::dvec3& x_in_portal);

}  // namespace arthro::authoring
