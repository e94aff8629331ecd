#include "simulation/tissue/field/solid_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/tissue/field/grid_cell.h"
#include "simulation/tissue/field/surface_distance.h"

namespace arthro::simulation {
namespace {

// Largest stored distance in spacings: 5.6 mm at 0.35 mm, the depth of a whole meniscus.
constexpr double kBandCells = 16.0;
// Nodes around the box of a surface, so that queries near it find distances and not bounds.
constexpr int kMargin = 4;
// Offset of the grid from the box in spacings, so that round coordinates of meshes and planes do
// not fall on grid nodes.
constexpr double kOffset = 0.381966;
constexpr std::int64_t kCellUnits = std::int64_t{1} << 30;

double DistanceOutside(const Box3& box, const glm::dvec3& x) noexcept {
  const glm::dvec3 centre = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
  const glm::dvec3 q = glm::abs(x - centre) - half;
  return glm::length(glm::max(q, glm::dvec3(0.0))) + std::min(0.0, std::max({q.x, q.y, q.z}));
}

}  // namespace

void SolidField::Prepare(const Box3& box, double spacing, std::int64_t max_cells) {
  if (!(spacing > 0.0) || !std::isfinite(spacing))
    throw Error(Code::kBadArgument,
                fmt::format("a field's spacing must be positive, not {}", spacing));
  grid_.spacing = spacing;
  double cells = 1.0;
  for (int a = 0; a < 3; ++a) {
    const double span = std::ceil((box.high[a] - box.low[a]) / spacing) + 2 * kMargin + 1;
    if (!std::isfinite(span) || span < 2.0)
      throw Error(Code::kBadArgument, "a field's box must be finite and not inside out");
    cells *= span;
    if (cells > static_cast<double>(max_cells)) break;
    grid_.count[static_cast<std::size_t>(a)] = static_cast<int>(span) + 1;
    grid_.origin[a] = box.low[a] - (kMargin + kOffset) * spacing;
    bricks_[static_cast<std::size_t>(a)] = (static_cast<int>(span) + kBrick - 1) / kBrick;
  }
  if (cells > static_cast<double>(max_cells))
    throw Error(Code::kBadArgument,
                fmt::format("a field of spacing {:.3g} mm would have more than {} cells; take a "
                            "larger spacing or a smaller box",
                            1e3 * spacing, max_cells));
  const auto brick_count = static_cast<std::size_t>(bricks_[0]) *
                           static_cast<std::size_t>(bricks_[1]) *
                           static_cast<std::size_t>(bricks_[2]);
  brick_volume_.assign(brick_count, 0);
  brick_version_.assign(brick_count, 0);
}

SolidField SolidField::FromSurface(const SurfaceMesh& surface, double spacing,
                                   std::int64_t max_cells, double around) {
  SolidField field;
  Box3 box{glm::dvec3(1e300), glm::dvec3(-1e300)};
  for (const auto& triangle : surface.triangles)
    for (const int vertex : triangle)
      if (vertex >= 0 && vertex < static_cast<int>(surface.vertices.size())) {
        const glm::dvec3& x = surface.vertices[static_cast<std::size_t>(vertex)];
        box.low = glm::min(box.low, x);
        box.high = glm::max(box.high, x);
      }
  if (surface.triangles.empty() || box.empty() || !std::isfinite(glm::length(box.high - box.low)))
    throw Error(Code::kBadMesh, "the surface is empty or not finite; a solid needs a closed one");
  field.Prepare({box.low - around, box.high + around}, spacing, max_cells);
  field.value_ = SignedDistances(surface, field.grid_, field.band());
  field.SumBricks();
  return field;
}

SolidField SolidField::FromFunction(const Box3& box, double spacing,
                                    const std::function<double(const glm::dvec3&)>& distance,
                                    std::int64_t max_cells) {
  SolidField field;
  field.Prepare(box, spacing, max_cells);
  field.value_.resize(field.grid_.NodeCount());
  const auto& n = field.grid_.count;
  const double band = field.band();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        const glm::dvec3 x = field.grid_.Place(i, j, k);
        const double d = std::max(distance(x), DistanceOutside(box, x));
        // A value that is not finite becomes the band, outside the solid.
        field.value_[field.grid_.Index(i, j, k)] =
            static_cast<float>(std::isfinite(d) ? std::clamp(d, -band, band) : band);
      }
  field.SumBricks();
  return field;
}

void SolidField::SumBricks() {
  for (int k = 0; k < bricks_[2]; ++k)
    for (int j = 0; j < bricks_[1]; ++j)
      for (int i = 0; i < bricks_[0]; ++i)
        volume_ += brick_volume_[BrickIndex(i, j, k)] = BrickVolume(i, j, k);
}

double SolidField::band() const { return kBandCells * grid_.spacing; }

Box3 SolidField::box() const {
  return {grid_.origin, grid_.Place(grid_.count[0] - 1, grid_.count[1] - 1, grid_.count[2] - 1)};
}

double SolidField::Volume() const { return VolumeOf(volume_); }

double SolidField::Distance(const glm::dvec3& x) const noexcept {
  if (value_.empty()) return band();
  const CellPlace place = Locate(grid_, x);
  const double inside = Interpolate(CornersAt(value_, grid_, place.index), place.part);
  const glm::dvec3 beyond = x - place.clamped;
  const double outside2 = glm::dot(beyond, beyond);
  // The solid lies within the box, so Pythagoras gives a lower bound of the distance.
  if (!(outside2 > 1e-18 * grid_.spacing * grid_.spacing)) return inside;
  return std::min(band(), std::sqrt(outside2 + inside * inside));
}

glm::dvec3 SolidField::Gradient(const glm::dvec3& x) const noexcept {
  if (value_.empty()) return glm::dvec3(0.0);
  const CellPlace place = Locate(grid_, x);
  const auto c = CornersAt(value_, grid_, place.index).value;
  const glm::dvec3 &t = place.part, s = 1.0 - t;
  const glm::dvec3 slope = glm::dvec3(s.z * (s.y * (c[1] - c[0]) + t.y * (c[3] - c[2])) +
                                          t.z * (s.y * (c[5] - c[4]) + t.y * (c[7] - c[6])),
                                      s.z * (s.x * (c[2] - c[0]) + t.x * (c[3] - c[1])) +
                                          t.z * (s.x * (c[6] - c[4]) + t.x * (c[7] - c[5])),
                                      s.y * (s.x * (c[4] - c[0]) + t.x * (c[5] - c[1])) +
                                          t.y * (s.x * (c[6] - c[2]) + t.x * (c[7] - c[3]))) /
                           grid_.spacing;
  const glm::dvec3 beyond = x - place.clamped;
  const double outside2 = glm::dot(beyond, beyond);
  if (!(outside2 > 1e-18 * grid_.spacing * grid_.spacing)) return slope;
  const double inside = Interpolate({c}, place.part);
  return (beyond + inside * slope) / std::sqrt(outside2 + inside * inside);
}

std::int64_t SolidField::CellUnits(int i, int j, int k) const {
  const double part = SolidPart(CornersAt(value_, grid_, grid_.Index(i, j, k)).value);
  return std::llround(part * static_cast<double>(kCellUnits));
}

double SolidField::VolumeOf(std::int64_t units) const {
  return static_cast<double>(units) / static_cast<double>(kCellUnits) * grid_.spacing *
         grid_.spacing * grid_.spacing;
}

double SolidField::CellVolume(int i, int j, int k) const { return VolumeOf(CellUnits(i, j, k)); }

std::int64_t SolidField::BrickVolume(int bi, int bj, int bk) const {
  std::int64_t sum = 0;
  const auto end = [&](int b, std::size_t a) {
    return std::min((b + 1) * kBrick, grid_.count[a] - 1);
  };
  for (int k = bk * kBrick; k < end(bk, 2); ++k)
    for (int j = bj * kBrick; j < end(bj, 1); ++j)
      for (int i = bi * kBrick; i < end(bi, 0); ++i) sum += CellUnits(i, j, k);
  return sum;
}

}  // namespace arthro::simulation
