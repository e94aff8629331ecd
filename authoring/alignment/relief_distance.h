// Distances of a tissue's surface from the relief: how well it lies on what the picture shows, and
// what of it lies behind. m, portal frame.
#pragma once

#include <memory>
#include <vector>

#include "simulation/core/frames.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/scene/mesh/surface_finder.h"

namespace arthro::authoring {

// Relief as a surface with a search structure. Cells across which the relief jumps are left out.
struct ReliefTarget {
  SurfaceMesh surface;
  std::vector<glm::dvec3> normals;  // one per triangle, towards the portal
  std::shared_ptr<const SurfaceFinder> finder;
  bool empty() const { return surface.triangles.empty(); }
};
ReliefTarget MakeReliefTarget(const LoadedScene& scene);

// Distance beyond which a vertex does not belong to what the relief shows, m.
inline constexpr double kReliefReach = 0.02;

// Signed distances of points: positive in front of the relief. NaN for a point that is farther than
// `reach` from it, or beside what was imaged.
std::vector<double> DistancesFrom(const ReliefTarget& relief, const std::vector<glm::dvec3>& points,
                                  double reach);

// Unit normals of a surface, one per vertex, in its own frame.
std::vector<glm::dvec3> NormalsOf(const SurfaceMesh& surface);

struct ReliefFit {
  double median = 0;      // m, of the unsigned distances of the points that face the portal
  double within = 0;      // share of those within kGoodDistance
  double behind = 0;      // share of those that lie behind the relief by kIntersecting and more
  double deepest = 0;     // m, of those
  bool is_known = false;  // false where the relief is nowhere near
};
inline constexpr double kGoodDistance = 1e-3;  // m

// Vertices that lie deeper than this are said to intersect the relief, m; a measured relief is not
// better known.
inline constexpr double kIntersecting = 0.5e-3;

ReliefFit FitOf(const ReliefTarget& relief, const SurfaceMesh& surface, const Pose& pose);

}  // namespace arthro::authoring
