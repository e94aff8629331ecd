// Strands of one tissue (strands.h) as a model seen through the lens. m, the tissue's own frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "app/view/drawing/lens_model.h"
#include "app/view/drawing/strands.h"

namespace arthro::app {

class StrandModel {
 public:
  // `whole`: the surface at rest, uncut.
  StrandModel(const simulation::TissueLook& look, const SurfaceMesh& whole);

  LensModel& model() { return model_; }
  bool empty() const { return strands_.empty(); }
  // Surface at rest that the strands grow on. `fresh` is 1 for a vertex of a cut face.
  void SetSurface(const SurfaceMesh& surface, std::span<const std::uint8_t> fresh);
  // Places of that surface's vertices.
  void SetShape(std::span<const glm::dvec3> positions);
  // Moves the strands to where they are at `time`, s. Does nothing when nothing moved.
  void Place(double time);

 private:
  simulation::TissueLook look_;
  TissueGrain grain_;
  std::vector<Strand> strands_;
  std::vector<glm::dvec3> positions_;
  double time_ = 0;
  bool is_placed_ = true;
  LensModel model_{LensModel::Look::kTissue};
};

}  // namespace arthro::app
