#include "simulation/tissue/cut/cutters.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/core/finite.h"

namespace arthro::simulation {
namespace {

// Margin around a cut in which distances are written, in spacings, so that the new surface is
// smooth.
constexpr double kMarginCells = 2.5;
// Minimum width of a slot in spacings; a narrower one may fall between nodes and not separate.
constexpr double kMinSlotCells = 1.5;

double DistanceToBox(const glm::dvec3& x, const glm::dvec3& half) noexcept {
  const glm::dvec3 q = glm::abs(x) - half;
  return glm::length(glm::max(q, glm::dvec3(0.0))) + std::min(0.0, std::max({q.x, q.y, q.z}));
}

// Distance to the parallelogram corner + s·u + t·v, 0 ≤ s, t ≤ 1.
double DistanceToParallelogram(const glm::dvec3& x, const glm::dvec3& corner, const glm::dvec3& u,
                               const glm::dvec3& v) noexcept {
  const glm::dvec3 w = x - corner;
  const double uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v);
  const double wu = glm::dot(w, u), wv = glm::dot(w, v), det = uu * vv - uv * uv;
  if (det > 1e-12 * uu * vv) {
    const double s = (wu * vv - wv * uv) / det, t = (wv * uu - wu * uv) / det;
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) return glm::length(w - s * u - t * v);
  }
  const auto to_edge = [&](const glm::dvec3& a, const glm::dvec3& edge) {
    return DistanceToCapsule(x, a, a + edge, 0.0);
  };
  return std::min(std::min(to_edge(corner, u), to_edge(corner + v, u)),
                  std::min(to_edge(corner, v), to_edge(corner + u, v)));
}

double DistanceToTear(const TearCut& tear, const glm::dvec3& x) noexcept {
  const glm::dvec3 into = glm::normalize(tear.into);
  double nearest = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i + 1 < tear.path.size(); ++i)
    nearest = std::min(nearest, DistanceToParallelogram(x, tear.path[i] - tear.lead * into,
                                                        tear.path[i + 1] - tear.path[i],
                                                        (tear.lead + tear.depth) * into));
  return nearest - 0.5 * tear.width;
}

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

}  // namespace

double DistanceToCapsule(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b,
                         double radius) noexcept {
  const glm::dvec3 ab = b - a, ax = x - a;
  const double length2 = glm::dot(ab, ab);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(ax, ab) / length2, 0.0, 1.0) : 0.0;
  return glm::length(ax - t * ab) - radius;
}

void CheckCut(const Cut& cut) {
  const bool is_good = std::visit(
      Overloaded{[](const CapsuleCut& c) {
                   return IsFinite(c.a) && IsFinite(c.b) && std::isfinite(c.radius) &&
                          c.radius > 0.0;
                 },
                 [](const BoxCut& c) {
                   const glm::dquat& q = c.rest_from_box.rotation;
                   return IsFinite(c.rest_from_box.translation) && IsFinite(c.half) &&
                          std::min({c.half.x, c.half.y, c.half.z}) > 0.0 &&
                          std::abs(glm::dot(q, q) - 1.0) < 1e-6;
                 },
                 [](const TearCut& c) {
                   return c.path.size() >= 2 &&
                          std::all_of(c.path.begin(), c.path.end(), IsFinite) && IsFinite(c.into) &&
                          glm::length(c.into) > 0.0 && std::isfinite(c.depth) && c.depth > 0.0 &&
                          std::isfinite(c.width) && c.width > 0.0 && std::isfinite(c.lead) &&
                          c.lead >= 0.0;
                 }},
      cut);
  if (!is_good)
    throw Error(Code::kBadArgument,
                "a cut has no extent or is not finite; give it a positive radius, width and depth, "
                "and a tear two points at least");
}

double DistanceTo(const Cut& cut, const glm::dvec3& x) noexcept {
  if (const auto* capsule = std::get_if<CapsuleCut>(&cut))
    return DistanceToCapsule(x, capsule->a, capsule->b, capsule->radius);
  if (const auto* box = std::get_if<BoxCut>(&cut))
    return DistanceToBox(Inverse(box->rest_from_box) * x, box->half);
  return DistanceToTear(*std::get_if<TearCut>(&cut), x);
}

Box3 BoundsOf(const Cut& cut, double margin) {
  Box3 box{glm::dvec3(1e300), glm::dvec3(-1e300)};
  const auto hold = [&](const glm::dvec3& x, double around) {
    box.low = glm::min(box.low, x - around);
    box.high = glm::max(box.high, x + around);
  };
  std::visit(Overloaded{[&](const CapsuleCut& c) {
                          hold(c.a, c.radius + margin);
                          hold(c.b, c.radius + margin);
                        },
                        [&](const BoxCut& c) {
                          for (int i = 0; i < 8; ++i)
                            hold(c.rest_from_box * (c.half * glm::dvec3((i & 1) != 0 ? 1 : -1,
                                                                        (i & 2) != 0 ? 1 : -1,
                                                                        (i & 4) != 0 ? 1 : -1)),
                                 margin);
                        },
                        [&](const TearCut& c) {
                          const glm::dvec3 into = glm::normalize(c.into);
                          for (const glm::dvec3& x : c.path) {
                            hold(x - c.lead * into, 0.5 * c.width + margin);
                            hold(x + c.depth * into, 0.5 * c.width + margin);
                          }
                        }},
             cut);
  return box;
}

FieldEdit Apply(SolidField& field, const Cut& cut) {
  CheckCut(cut);
  Cut wide = cut;
  if (auto* tear = std::get_if<TearCut>(&wide))
    tear->width = std::max(tear->width, kMinSlotCells * field.spacing());
  return field.Subtract(BoundsOf(wide, kMarginCells * field.spacing()),
                        [&](const glm::dvec3& x) { return DistanceTo(wide, x); });
}

SolidField CutAll(const SolidField& original, std::span<const Cut> cuts) {
  SolidField field = original;
  for (const Cut& cut : cuts) Apply(field, cut);
  return field;
}

FieldEdit SubtractDeformed(SolidField& field, const Box3& rest_box, const Deformation& deformation,
                           const ToolDistance& distance) {
  return field.Subtract(rest_box, [&](const glm::dvec3& rest) {
    glm::dvec3 place;
    return deformation(rest, place) ? distance(place) : std::numeric_limits<double>::quiet_NaN();
  });
}

FieldEdit Shave(SolidField& field, const Box3& rest_box, const Deformation& deformation,
                const ToolDistance& distance, const ShaverOptions& options, double dt,
                Shaver& shaver) {
  // An idle shaver does not accumulate allowance: that suction was lost.
  constexpr double kLongestSaved = 0.05;  // s
  if (!(dt > 0.0) || !std::isfinite(dt)) return {};
  shaver.allowance =
      std::min(shaver.allowance + options.rate * dt, options.rate * std::max(kLongestSaved, dt));
  if (shaver.allowance <= 0.0) return {};
  const FieldEdit edit = field.Erode(
      rest_box,
      [&](const glm::dvec3& rest) {
        glm::dvec3 place;
        return deformation(rest, place) ? distance(place)
                                        : std::numeric_limits<double>::quiet_NaN();
      },
      shaver.allowance);
  shaver.allowance -= edit.removed;
  return edit;
}

namespace {

// Index of the first region that holds the middle of a cell; the number of regions: none does.
std::size_t RegionOfCell(const FieldGrid& grid, int i, int j, int k,
                         std::span<const Region> regions) {
  const glm::dvec3 middle = grid.Place(i, j, k) + 0.5 * grid.spacing;
  const auto region = std::find_if(regions.begin(), regions.end(), [&](const Region& r) {
    return glm::length(middle - r.ball.centre) <= r.ball.radius;
  });
  return static_cast<std::size_t>(region - regions.begin());
}

}  // namespace

std::vector<double> VolumeByRegion(const SolidField& field, std::span<const Region> regions) {
  const FieldGrid& grid = field.grid();
  std::vector<double> volumes(regions.size() + 1, 0.0);
  for (int k = 0; k + 1 < grid.count[2]; ++k)
    for (int j = 0; j + 1 < grid.count[1]; ++j)
      for (int i = 0; i + 1 < grid.count[0]; ++i)
        if (const double volume = field.CellVolume(i, j, k); volume > 0)
          volumes[RegionOfCell(grid, i, j, k, regions)] += volume;
  return volumes;
}

std::vector<RegionVolume> RemovedByRegion(const SolidField& original, const SolidField& now,
                                          std::span<const Region> regions) {
  const FieldGrid &grid = original.grid(), &other = now.grid();
  if (grid.count != other.count || grid.origin != other.origin || grid.spacing != other.spacing)
    throw Error(Code::kBadArgument,
                "volumes of two fields on different grids cannot be compared; cut a copy of the "
                "original instead");
  std::vector<RegionVolume> volumes;
  for (const Region& region : regions) volumes.push_back({region.name, 0.0});
  volumes.push_back({kElsewhere, 0.0});
  // Most rows of cells have four unchanged rows of nodes.
  const auto row = [&](const SolidField& field, int j, int k) {
    return field.values().subspan(grid.Index(0, j, k), static_cast<std::size_t>(grid.count[0]));
  };
  const auto is_same = [&](int j, int k) {
    return std::ranges::equal(row(original, j, k), row(now, j, k));
  };
  for (int k = 0; k + 1 < grid.count[2]; ++k)
    for (int j = 0; j + 1 < grid.count[1]; ++j) {
      if (is_same(j, k) && is_same(j + 1, k) && is_same(j, k + 1) && is_same(j + 1, k + 1))
        continue;
      for (int i = 0; i + 1 < grid.count[0]; ++i) {
        const double removed = original.CellVolume(i, j, k) - now.CellVolume(i, j, k);
        if (removed == 0.0) continue;
        volumes[RegionOfCell(grid, i, j, k, regions)].removed += removed;
      }
    }
  return volumes;
}

CrumbReport RemoveDebris(SolidField& field, std::span<const Ball> fixed) {
  if (fixed.empty()) return {};
  const FieldPieces pieces = PiecesWithoutVolumes(field);
  std::vector<unsigned char> is_debris = HeldPieces(field, pieces, fixed);
  for (std::size_t i = 0; i < is_debris.size(); ++i)
    is_debris[i] =
        is_debris[i] == 0 && VolumeOfPiece(field, pieces, static_cast<int>(i)) < kDebrisVolume;
  return RemovePieces(field, pieces, is_debris);
}

MadeCuts MakeCuts(SolidField& field, std::span<const Cut> cuts, std::span<const Ball> fixed) {
  MadeCuts made;
  for (const Cut& cut : cuts) {
    const FieldEdit edit = Apply(field, cut);
    made.removed.push_back(edit.removed);
    made.changed = Union(made.changed, edit.changed);
  }
  if (made.changed.empty()) return made;
  made.washed = RemoveDebris(field, fixed);
  made.changed = Union(made.changed, made.washed.edit.changed);
  if (!(field.Volume() > 0.0))
    throw Error(Code::kBadScene,
                "its cuts leave nothing of it; remove one of \"cuts\" or make it smaller");
  return made;
}

}  // namespace arthro::simulation
