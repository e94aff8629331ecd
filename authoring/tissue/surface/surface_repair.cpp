#include "authoring/tissue/surface/surface_repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "authoring/tissue/surface/surface_topology.h"
#include "authoring/tissue/surface/time_limit.h"

namespace arthro::authoring {
namespace {

using Triangle = std::array<int, 3>;

constexpr const char* kRepairStage = "repairing the surface";

bool RepeatsACorner(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

// Keeps the triangles for which `keep` holds, with their numbers.
template <class F>
int KeepTriangles(RepairedSurface& mended, F&& keep) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mended.surface.triangles.size(); ++t) {
    if (!keep(static_cast<int>(t))) continue;
    mended.surface.triangles[kept] = mended.surface.triangles[t];
    mended.source_triangle[kept++] = mended.source_triangle[t];
  }
  const int dropped = static_cast<int>(mended.surface.triangles.size() - kept);
  mended.surface.triangles.resize(kept);
  mended.source_triangle.resize(kept);
  return dropped;
}

// Merges a vertex with the first one before it that is nearer than the tolerance, by a lookup in
// cells of that size.
int Weld(SurfaceMesh& surface, const Progress& progress) {
  if (surface.vertices.empty()) return 0;
  glm::dvec3 low = surface.vertices[0], high = low;
  for (const glm::dvec3& x : surface.vertices) low = glm::min(low, x), high = glm::max(high, x);
  const double tolerance = kWeldShare * glm::distance(low, high);
  if (!(tolerance > 0)) return 0;
  using Cell = std::array<long long, 3>;
  std::map<Cell, std::vector<int>> cells;
  std::vector<int> target(surface.vertices.size());
  int welded = 0;
  StageSteps steps(progress, kRepairStage, surface.vertices.size());
  for (int i = 0; i < static_cast<int>(surface.vertices.size()); ++i) {
    const glm::dvec3 x = surface.vertices[i], at = (x - low) / tolerance;
    const Cell cell = {std::llround(at.x), std::llround(at.y), std::llround(at.z)};
    target[i] = i;
    steps.Next();
    for (long long dx = -1; dx <= 1; ++dx)
      for (long long dy = -1; dy <= 1; ++dy)
        for (long long dz = -1; dz <= 1; ++dz) {
          const auto found = cells.find({cell[0] + dx, cell[1] + dy, cell[2] + dz});
          if (found == cells.end()) continue;
          for (const int other : found->second)
            if (other < target[i] && glm::distance(surface.vertices[other], x) <= tolerance)
              target[i] = other;
        }
    if (target[i] == i)
      cells[cell].push_back(i);
    else
      ++welded;
  }
  for (Triangle& triangle : surface.triangles)
    for (int& corner : triangle) corner = target[corner];
  return welded;
}

int DropDuplicates(RepairedSurface& mended, const Progress& progress) {
  std::set<Triangle> seen;
  StageSteps steps(progress, kRepairStage, mended.surface.triangles.size());
  return KeepTriangles(mended, [&](int t) {
    steps.Next();
    Triangle corners = mended.surface.triangles[t];
    std::sort(corners.begin(), corners.end());
    return seen.insert(corners).second;
  });
}

// A triangle without area has a corner b on its side ac. The neighbour across that side, acd,
// becomes abd and bcd: the same surface without the line. One pass; several lines in a row need
// several.
int FlattenOnce(SurfaceMesh& surface, const Progress& progress) {
  std::vector<int> lines;
  for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t)
    if (HasNoArea(surface, surface.triangles[t])) lines.push_back(t);
  if (lines.empty()) return 0;

  std::map<std::pair<int, int>, int> triangle_left_of;  // per directed side; -1 when not unique
  StageSteps steps(progress, kRepairStage, surface.triangles.size());
  for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t)
    for (int i = 0; i < 3; ++i) {
      if (i == 0) steps.Next();
      const std::pair side{surface.triangles[t][i], surface.triangles[t][(i + 1) % 3]};
      if (const auto [entry, is_new] = triangle_left_of.try_emplace(side, t); !is_new)
        entry->second = -1;
    }
  int flattened = 0;
  std::set<int> touched;
  for (const int t : lines) {
    const Triangle line = surface.triangles[t];
    int longest = 0;  // side i runs from corner i to i + 1
    const auto length = [&](int i) {
      return glm::distance(surface.vertices[line[i]], surface.vertices[line[(i + 1) % 3]]);
    };
    for (int i = 1; i < 3; ++i)
      if (length(i) > length(longest)) longest = i;
    const int c = line[longest], a = line[(longest + 1) % 3], b = line[(longest + 2) % 3];
    const auto found = triangle_left_of.find({a, c});
    if (found == triangle_left_of.end() || found->second < 0) continue;
    const int neighbour = found->second;
    if (touched.contains(t) || touched.contains(neighbour)) continue;
    const Triangle other = surface.triangles[neighbour];
    const int d = other[0] + other[1] + other[2] - a - c;
    if (d == b || triangle_left_of.contains({b, d}) || triangle_left_of.contains({d, b})) continue;
    // t was c a b; the neighbour was a c d.
    surface.triangles[t] = {a, b, d};
    surface.triangles[neighbour] = {b, c, d};
    touched.insert({t, neighbour});
    ++flattened;
  }
  return flattened;
}

// Returns loops of open sides, each followed against the direction of its triangles, so that
// filling triangles face as they do. A corner with more than one continuation belongs to no simple
// hole.
std::vector<std::vector<int>> OpenLoops(const SurfaceMesh& surface) {
  std::map<int, std::vector<int>> next;
  ForEachEdge(SortedEdgeUses(surface), [&](auto first, auto last) {
    if (last - first != 1) return;
    next[first->forward ? first->b : first->a].push_back(first->forward ? first->a : first->b);
  });
  std::vector<std::vector<int>> loops;
  std::set<int> visited;
  for (const auto& [start, ways] : next) {
    std::vector<int> loop;
    int at = start;
    while (visited.insert(at).second) {
      const auto found = next.find(at);
      if (found == next.end() || found->second.size() != 1) {
        loop.clear();
        break;
      }
      loop.push_back(at);
      at = found->second[0];
    }
    if (loop.size() >= 3 && at == start) loops.push_back(std::move(loop));
  }
  return loops;
}

// Fills a loop by repeatedly cutting off the corner with the shortest cut.
int FillHoles(RepairedSurface& mended, int most_sides, const Progress& progress) {
  int filled = 0;
  StageSteps steps(progress, kRepairStage, 0);
  for (std::vector<int> loop : OpenLoops(mended.surface)) {
    steps.Next();
    if (static_cast<int>(loop.size()) > most_sides) continue;
    while (loop.size() >= 3) {
      const std::size_t n = loop.size();
      std::size_t best = 0;
      const auto cut = [&](std::size_t i) {
        return glm::distance(mended.surface.vertices[loop[(i + n - 1) % n]],
                             mended.surface.vertices[loop[(i + 1) % n]]);
      };
      for (std::size_t i = 1; i < n && n > 3; ++i)
        if (cut(i) < cut(best)) best = i;
      mended.surface.triangles.push_back(
          {loop[(best + n - 1) % n], loop[best], loop[(best + 1) % n]});
      mended.source_triangle.push_back(-1);
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(best));
    }
    ++filled;
  }
  return filled;
}

// Turns triangles to face as the first of their component does, across edges of exactly two
// triangles.
int OrientConsistently(SurfaceMesh& surface, const std::vector<EdgeUse>& uses) {
  struct Neighbour {
    int triangle;
    bool must_turn;  // faces the other way
  };
  std::vector<std::vector<Neighbour>> neighbours(surface.triangles.size());
  ForEachEdge(uses, [&](auto first, auto last) {
    if (last - first != 2) return;
    const auto second = first + 1;
    const bool must_turn = first->forward == second->forward;
    neighbours[first->triangle].push_back({second->triangle, must_turn});
    neighbours[second->triangle].push_back({first->triangle, must_turn});
  });
  std::vector<int> state(surface.triangles.size(), -1);  // 1: turned
  int turned = 0;
  for (std::size_t seed = 0; seed < state.size(); ++seed) {
    if (state[seed] >= 0) continue;
    state[seed] = 0;
    std::vector<int> members = {static_cast<int>(seed)};
    int turned_here = 0;
    for (std::size_t i = 0; i < members.size(); ++i)
      for (const Neighbour& neighbour : neighbours[members[i]]) {
        if (state[neighbour.triangle] >= 0) continue;
        state[neighbour.triangle] = state[members[i]] ^ static_cast<int>(neighbour.must_turn);
        turned_here += state[neighbour.triangle];
        members.push_back(neighbour.triangle);
      }
    // The majority decides.
    const bool invert = 2 * turned_here > static_cast<int>(members.size());
    for (const int t : members)
      if ((state[t] == 1) != invert) std::swap(surface.triangles[t][1], surface.triangles[t][2]);
    turned += invert ? static_cast<int>(members.size()) - turned_here : turned_here;
  }
  return turned;
}

// Turns closed components that face inwards, and drops those that are too small.
void SettleComponents(RepairedSurface& mended, double drop_below_share) {
  SurfaceMesh& surface = mended.surface;
  const auto uses = SortedEdgeUses(surface);
  int count = 0;
  const auto component_of = ComponentOfTriangles(surface, uses, &count);
  std::vector<char> is_closed(static_cast<std::size_t>(count), true);
  ForEachEdge(uses, [&](auto first, auto last) {
    if (last - first != 2 || first->forward == (first + 1)->forward)
      is_closed[component_of[first->triangle]] = false;
  });
  std::vector<std::vector<Triangle>> triangles(static_cast<std::size_t>(count));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    triangles[component_of[t]].push_back(surface.triangles[t]);
  std::vector<double> volume(static_cast<std::size_t>(count));
  double whole = 0;
  for (int i = 0; i < count; ++i) {
    volume[i] = SignedVolume(surface.vertices, triangles[i]);
    whole += std::abs(volume[i]);
    mended.repairs.flipped_components += is_closed[i] && volume[i] < 0;
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (is_closed[component_of[t]] && volume[component_of[t]] < 0)
      std::swap(surface.triangles[t][1], surface.triangles[t][2]);
  if (drop_below_share <= 0) return;
  const auto is_kept = [&](int i) { return std::abs(volume[i]) >= drop_below_share * whole; };
  KeepTriangles(mended, [&](int t) { return is_kept(component_of[t]); });
  for (int i = 0; i < count; ++i) mended.repairs.dropped_components += !is_kept(i);
}

int DropUnreferenced(SurfaceMesh& surface) {
  std::vector<int> index(surface.vertices.size(), -1);
  for (const Triangle& triangle : surface.triangles)
    for (const int corner : triangle) index[corner] = 0;
  int kept = 0;
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (index[i] < 0) continue;
    surface.vertices[kept] = surface.vertices[i];
    index[i] = kept++;
  }
  surface.vertices.resize(static_cast<std::size_t>(kept));
  for (Triangle& triangle : surface.triangles)
    for (int& corner : triangle) corner = index[corner];
  return static_cast<int>(index.size()) - kept;
}

}  // namespace

RepairedSurface RepairSurface(const SurfaceMesh& surface, const SurfaceRepairOptions& options,
                              const Progress& progress) {
  RepairedSurface mended{surface, {}, {}};
  for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t)
    mended.source_triangle.push_back(t);
  SurfaceRepairs& repairs = mended.repairs;

  repairs.welded_vertices = Weld(mended.surface, progress);
  repairs.collapsed_triangles =
      KeepTriangles(mended, [&](int t) { return !RepeatsACorner(mended.surface.triangles[t]); });
  repairs.duplicate_triangles = DropDuplicates(mended, progress);
  progress.Step(kRepairStage, 0.5);
  repairs.reoriented_triangles = OrientConsistently(mended.surface, SortedEdgeUses(mended.surface));
  for (int pass = 0; pass < 10; ++pass) {
    progress.Step(kRepairStage, 0.8);
    const int flattened = FlattenOnce(mended.surface, progress);
    repairs.flattened_triangles += flattened;
    if (flattened == 0) break;
  }
  if (options.fill_holes > 0)
    repairs.filled_holes = FillHoles(mended, options.fill_holes, progress);
  progress.Step(kRepairStage, 0.9);
  SettleComponents(mended, options.drop_below_share);
  // Welded vertices are unreferenced as well; they are counted once.
  repairs.unreferenced_vertices = DropUnreferenced(mended.surface) - repairs.welded_vertices;
  return mended;
}

}  // namespace arthro::authoring
