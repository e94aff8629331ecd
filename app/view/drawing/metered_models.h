// What the camera's automatic gain sees of the models: distance and brightness at some 3200 places
// of the round window, drawn on the processor. The places lie unevenly, so that no straight edge
// meets many of them at once: a model that comes into view turns the gain up or down by little
// steps. Lens' frame, m.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/frames.h"
#include "simulation/scope/window_lens.h"

namespace arthro::app {

struct MeteredSurface {
  std::span<const float> xyz;                     // of its vertices, in its own frame
  std::span<const std::array<int, 3>> triangles;  // counter-clockwise from outside
  bool is_closed = false;                         // its inside is never seen
  Pose portal_from_surface;
  double luma = 0.5;  // of its colour in the lamp's light, linear
};

class MeteredModels {
 public:
  static constexpr int kAcross = 64;  // places, over the window's width
  struct Place {
    float distance = 0;  // from the tip; 0: no model
    float luma = 0;      // as bright as it is lit, but for the lamp's distance
  };
  // Right and up in the window's radii.
  static glm::vec2 WindowPlace(int column, int row) noexcept;

  MeteredModels();
  // Nothing drawn yet, through this lens.
  void Begin(const simulation::ScopeView& view, const simulation::ScopeOptics& optics);
  // Takes memory only for a surface larger than those before. A triangle of which a corner lies
  // behind the lens is left out.
  void Draw(const MeteredSurface& surface);

  bool empty() const { return !has_any_; }
  // Row 0 is the window's top.
  const Place& at(int column, int row) const {
    return places_[static_cast<std::size_t>(row * kAcross + column)];
  }

 private:
  struct Corner {
    glm::vec3 point{0.0f};   // lens' frame: right, up, ahead
    glm::vec2 place{0.0f};   // in the window
    float per_distance = 0;  // 1/m; 0: behind the lens or no number
  };
  void DrawTriangle(const Corner& a, const Corner& b, const Corner& c, bool is_closed, float luma);

  simulation::ScopeView view_;
  simulation::ScopeOptics optics_;
  float place_scale_ = 1;  // of sin(angle/2) to the window's radii
  std::vector<glm::vec2> window_places_;
  std::vector<Place> places_;
  std::vector<Corner> corners_;
  bool has_any_ = false;
};

}  // namespace arthro::app
