// Models as the automatic gain meters them: distance and brightness at some 3200 places of the
// round window, drawn on the processor. The places are irregular, so that no straight edge meets
// many of them at once and a model that comes into view changes the gain in small steps. Lens
// frame, m.
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
  std::span<const float> xyz;                     // vertices, in its own frame
  std::span<const std::array<int, 3>> triangles;  // counter-clockwise from outside
  bool is_closed = false;                         // its inside is never seen
  Pose portal_from_surface;
  double luma = 0.5;      // luma of its colour in the lamp's light, linear
  bool is_plate = false;  // lit like the backdrop that it lies on
};

class MeteredModels {
 public:
  static constexpr int kAcross = 64;  // places across the window
  struct Place {
    float distance = 0;  // from the tip; 0: no model
    float luma = 0;      // brightness, without the lamp's distance
  };
  // Window place, right and up, in window radii.
  static glm::vec2 WindowPlace(int column, int row) noexcept;

  MeteredModels();
  // Clears the places for a picture through this lens.
  void Begin(const simulation::ScopeView& view, const simulation::ScopeOptics& optics);
  // Allocates only for a surface larger than all before. Leaves out a triangle with a corner behind
  // the lens.
  void Draw(const MeteredSurface& surface);

  bool empty() const { return !has_any_; }
  // Row 0 is the top of the window.
  const Place& at(int column, int row) const { return places_[IndexOf(column, row)]; }

 private:
  static std::size_t IndexOf(int column, int row) {
    return static_cast<std::size_t>(row) * kAcross + static_cast<std::size_t>(column);
  }
  struct Corner {
    glm::vec3 point{0.0f};   // lens frame: right, up, ahead
    glm::vec2 place{0.0f};   // place in the window
    float per_distance = 0;  // 1/m; 0: behind the lens or not finite
  };
  void DrawTriangle(const Corner& a, const Corner& b, const Corner& c,
                    const MeteredSurface& surface);

  simulation::ScopeView view_;
  simulation::ScopeOptics optics_;
  float place_scale_ = 1;  // window radii per sin(angle/2)
  std::vector<glm::vec2> window_places_;
  std::vector<Place> places_;
  std::vector<Corner> corners_;
  bool has_any_ = false;
};

}  // namespace arthro::app
