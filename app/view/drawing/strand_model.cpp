#include "app/view/drawing/strand_model.h"

#include <algorithm>

namespace arthro::app {

StrandModel::StrandModel(const simulation::TissueLook& look, const SurfaceMesh& whole)
    : look_(look), grain_(whole, look.structure) {
  simulation::TissueLook plain = look;
  plain.structure = simulation::TissueStructure::kPlain;
  model_.SetLook(plain, {});
  SetSurface(whole, {});
}

void StrandModel::SetSurface(const SurfaceMesh& surface, std::span<const std::uint8_t> fresh) {
  strands_ = FrayedFibres(surface, fresh, grain_, look_);
  const std::size_t frayed = strands_.size();
  const std::vector<Strand> villi = Villi(surface, look_);
  strands_.insert(strands_.end(), villi.begin(), villi.end());
  positions_ = surface.vertices;
  const StrandMesh mesh = MeshOf(strands_, positions_, time_);
  // Frayed fibres have the colour of a cut face.
  std::vector<std::uint8_t> marks(mesh.surface.vertices.size(), 0);
  if (!strands_.empty())
    std::fill_n(marks.begin(), frayed * (marks.size() / strands_.size()), std::uint8_t{1});
  model_.SetSurface(mesh.surface, marks);
  model_.SetShape(mesh.surface.vertices, mesh.normals);
  is_placed_ = true;
}

void StrandModel::SetShape(std::span<const glm::dvec3> positions) {
  if (strands_.empty() || std::ranges::equal(positions, positions_)) return;
  positions_.assign(positions.begin(), positions.end());
  is_placed_ = false;
}

void StrandModel::Place(double time) {
  if (strands_.empty() || (is_placed_ && time == time_)) return;
  time_ = time;
  is_placed_ = true;
  const StrandMesh mesh = MeshOf(strands_, positions_, time_);
  model_.SetShape(mesh.surface.vertices, mesh.normals);
}

}  // namespace arthro::app
