#include "authoring/tissue/surface_faults.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "authoring/tissue/surface/self_intersection.h"
#include "authoring/tissue/surface/surface_repair.h"
#include "authoring/tissue/surface/surface_thicken.h"
#include "authoring/tissue/surface/surface_topology.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/mesh/surface_finder.h"

namespace arthro::authoring {
namespace {

constexpr int kMostHoleSides = 100;

void AddTriangle(SurfaceFault& fault, const std::array<glm::dvec3, 3>& corners) {
  fault.triangles.push_back(corners);
  for (std::size_t i = 0; i < 3; ++i) fault.edges.push_back({corners[i], corners[(i + 1) % 3]});
}

std::string Counted(int count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

// Smallest angle of a triangle, rad.
double SmallestAngle(const std::array<glm::dvec3, 3>& x) {
  double least = 4;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 u = x[(i + 1) % 3] - x[i], v = x[(i + 2) % 3] - x[i];
    least = std::min(least, std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)));
  }
  return least;
}

RepairedSurface Repaired(const SurfaceMesh& surface, bool fills_holes, const Progress& progress) {
  SurfaceRepairOptions options;
  options.fill_holes = fills_holes ? kMostHoleSides : 0;
  options.most_hole_share = kMostHoleShare;
  return RepairSurface(surface, options, progress);
}

std::string WordsOf(const SurfaceRepairs& repairs) {
  std::string words;
  const auto add = [&](int count, const char* one, const char* many) {
    if (count > 0) words += (words.empty() ? "" : ", ") + Counted(count, one, many);
  };
  add(repairs.welded_vertices, "welded vertex", "welded vertices");
  add(repairs.collapsed_triangles + repairs.duplicate_triangles, "dropped triangle",
      "dropped triangles");
  add(repairs.flattened_triangles, "triangle without area", "triangles without area");
  add(repairs.reoriented_triangles, "turned triangle", "turned triangles");
  add(repairs.flipped_components, "part turned inside out", "parts turned inside out");
  add(repairs.filled_holes, "filled hole", "filled holes");
  return words;
}

// Triangles of the input that a repair drops or turns.
SurfaceFault UntidyOf(const SurfaceMesh& surface, const RepairedSurface& repaired) {
  // A vertex without a triangle is no part of the surface.
  SurfaceFault fault{FaultKind::kUntidy,
                     repaired.repairs.Total() - repaired.repairs.unreferenced_vertices,
                     {},
                     {},
                     {}};
  std::set<int> kept;
  const auto& sources = repaired.source_triangle;
  for (std::size_t t = 0; t < sources.size(); ++t) {
    const auto source = static_cast<std::size_t>(sources[t]);
    const auto now = CornersOf(repaired.surface, t), before = CornersOf(surface, source);
    const double facing = glm::dot(glm::cross(now[1] - now[0], now[2] - now[0]),
                                   glm::cross(before[1] - before[0], before[2] - before[0]));
    if (facing > 0) kept.insert(sources[t]);
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (!kept.contains(static_cast<int>(t))) AddTriangle(fault, CornersOf(surface, t));
  fault.sentence = "Untidy: " + WordsOf(repaired.repairs) + " when it is mended.";
  return fault;
}

void AddOpenings(const SurfaceMesh& surface, SurfaceFault& holes, SurfaceFault& sheets) {
  const double area = AreaOf(surface);
  std::set<std::array<int, 2>> of_holes;
  for (const std::vector<int>& loop : OpenLoops(surface)) {
    const bool is_hole = static_cast<int>(loop.size()) <= kMostHoleSides &&
                         LoopArea(surface, loop) <= kMostHoleShare * area;
    SurfaceFault& fault = is_hole ? holes : sheets;
    ++fault.count;
    for (std::size_t i = 0; is_hole && i < loop.size(); ++i) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      of_holes.insert({std::min(a, b), std::max(a, b)});
      fault.edges.push_back({surface.vertices[a], surface.vertices[b]});
    }
  }
  // Open sides that belong to no simple loop are part of a rim too.
  ForEachEdge(SortedEdgeUses(surface), [&](auto first, auto last) {
    if (last - first == 1 && !of_holes.contains({first->a, first->b}))
      sheets.edges.push_back({surface.vertices[first->a], surface.vertices[first->b]});
  });
  if (!sheets.edges.empty()) sheets.count = std::max(sheets.count, 1);
  holes.sentence =
      Counted(holes.count, "small hole, which", "small holes, which") + " can be filled.";
  sheets.sentence =
      "An open sheet with " + Counted(sheets.count, "rim", "rims") +
      ". As thin cartilage it is touched as it is; to fill it with tetrahedra, make it a layer.";
}

void RefuseCrossings(const SurfaceMesh& surface, const std::string& what, const char* remedy,
                     int allowed, const Progress& progress) {
  const auto pairs = FindSelfIntersections(surface, kMostPairs, progress);
  if (static_cast<int>(pairs.size()) <= allowed) return;
  throw Error(Code::kBadMesh, fmt::format("{} would run through itself at {}; {}", what,
                                          Counted(static_cast<int>(pairs.size()) - allowed,
                                                  "pair of triangles", "pairs of triangles"),
                                          remedy));
}

}  // namespace

bool SurfaceFaults::Has(FaultKind kind) const {
  return std::any_of(faults.begin(), faults.end(),
                     [&](const SurfaceFault& fault) { return fault.kind == kind; });
}

SurfaceFaults FindSurfaceFaults(const SurfaceMesh& surface, const Progress& progress) {
  const RepairedSurface repaired = Repaired(surface, false, progress);
  const SurfaceMesh& tidy = repaired.surface;
  SurfaceFault untidy = UntidyOf(surface, repaired);
  SurfaceFault holes{FaultKind::kHole, 0, {}, {}, {}}, sheets{FaultKind::kSheet, 0, {}, {}, {}};
  AddOpenings(tidy, holes, sheets);

  SurfaceFault branching{FaultKind::kBranching, 0, {}, {}, {}};
  ForEachEdge(SortedEdgeUses(tidy), [&](auto first, auto last) {
    if (last - first <= 2) return;
    ++branching.count;
    branching.edges.push_back({tidy.vertices[first->a], tidy.vertices[first->b]});
  });
  branching.sentence = Counted(branching.count, "edge joins", "edges join") +
                       " more than two triangles. Which sheet is the outer one is not known: "
                       "separate them where the surface was made.";

  SurfaceFault crossing{FaultKind::kCrossing, 0, {}, {}, {}};
  std::set<int> crossed;
  for (const IntersectingPair& pair : FindSelfIntersections(tidy, kMostPairs, progress)) {
    ++crossing.count;
    crossed.insert({pair.first, pair.second});
  }
  for (const int t : crossed) AddTriangle(crossing, CornersOf(tidy, static_cast<std::size_t>(t)));
  crossing.sentence =
      "It runs through itself at " +
      Counted(crossing.count, "pair of triangles", "pairs of triangles") +
      ". Which side is the inside is not known: unite or separate the parts where it was made.";

  SurfaceFault slivers{FaultKind::kSliver, 0, {}, {}, {}};
  for (std::size_t t = 0; t < tidy.triangles.size(); ++t) {
    const auto corners = CornersOf(tidy, t);
    if (!(SmallestAngle(corners) < kSliverAngle)) continue;
    ++slivers.count;
    AddTriangle(slivers, corners);
  }
  slivers.sentence = Counted(slivers.count, "sliver", "slivers") +
                     " with an angle below 2°. Making tetrahedra replaces them.";

  SurfaceFaults found;
  for (SurfaceFault* fault : {&untidy, &holes, &sheets, &branching, &crossing, &slivers})
    if (fault->count > 0) found.faults.push_back(std::move(*fault));
  return found;
}

SurfaceMesh MendSurface(const SurfaceMesh& surface, std::string* what, const Progress& progress) {
  const auto before =
      FindSelfIntersections(Repaired(surface, false, progress).surface, kMostPairs, progress);
  RepairedSurface mended = Repaired(surface, true, progress);
  if (mended.repairs.filled_holes > 0)
    RefuseCrossings(mended.surface, "a filled hole", "fill it where the surface was made",
                    static_cast<int>(before.size()), progress);
  if (what) *what = WordsOf(mended.repairs);
  return std::move(mended.surface);
}

SurfaceMesh MakeLayer(const SurfaceMesh& surface, double thickness, const Progress& progress) {
  RepairedSurface mended = Repaired(surface, true, progress);
  if (ThickenOpenParts(mended, thickness) == 0)
    throw Error(Code::kBadMesh, "this surface is closed, so it has a thickness already");
  RefuseCrossings(mended.surface, fmt::format("a layer of {:g} mm", MmFromMetres(thickness)),
                  "choose a thinner one, or the other side by a negative thickness", 0, progress);
  return std::move(mended.surface);
}

}  // namespace arthro::authoring
