#include "authoring/tissue/surface/surface_check.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "authoring/tissue/surface/self_intersection.h"
#include "authoring/tissue/surface/surface_topology.h"
#include "authoring/tissue/surface/time_limit.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

// Range of the diagonal of a tissue's bounding box: from a trimmed piece of a horn to the cartilage
// of a whole knee.
constexpr double kSmallestTissue = 1e-3, kLargestTissue = 0.3;  // m
constexpr const char* kCheckStage = "checking the surface";
constexpr double kTinyComponent = 1e-3;  // share of the largest component's volume

glm::dvec3 Centre(const SurfaceMesh& surface, int t) {
  const auto& [a, b, c] = surface.triangles[t];
  return (surface.vertices[a] + surface.vertices[b] + surface.vertices[c]) / 3.0;
}

void CheckTriangles(const SurfaceMesh& surface, SurfaceCheck& check, const Progress& progress) {
  StageSteps steps(progress, kCheckStage, surface.triangles.size());
  std::map<std::array<int, 3>, int> first;
  for (int t = 0; t < check.triangles; ++t) {
    steps.Next();
    auto corners = surface.triangles[t];
    const glm::dvec3 &x = surface.vertices[corners[0]], &y = surface.vertices[corners[1]],
                     &z = surface.vertices[corners[2]];
    check.area += 0.5 * glm::length(glm::cross(y - x, z - x));
    if (HasNoArea(surface, corners)) check.degenerate.Add(Centre(surface, t), t);
    std::sort(corners.begin(), corners.end());
    if (const auto [entry, is_new] = first.try_emplace(corners, t); !is_new)
      check.duplicate.Add(Centre(surface, t), entry->second, t);
  }
}

void CheckEdges(const SurfaceMesh& surface, const std::vector<EdgeUse>& uses, SurfaceCheck& check) {
  ForEachEdge(uses, [&](auto first, auto last) {
    const glm::dvec3 middle = 0.5 * (surface.vertices[first->a] + surface.vertices[first->b]);
    const auto count = last - first;
    if (count == 1)
      check.open_edges.Add(middle, first->triangle);
    else if (count > 2)
      check.nonmanifold_edges.Add(middle, first->triangle, (first + 1)->triangle);
    else if (first->forward == (first + 1)->forward)
      check.flipped.Add(middle, first->triangle, (first + 1)->triangle);
  });
}

// Around a manifold vertex all triangles are connected through the edges at that vertex.
void CheckVertices(const SurfaceMesh& surface, const std::vector<EdgeUse>& uses,
                   SurfaceCheck& check) {
  DisjointSets corners(3 * check.triangles);
  const auto corner_at = [&](int t, int vertex) {
    const auto& triangle = surface.triangles[t];
    return 3 * t +
           static_cast<int>(std::find(triangle.begin(), triangle.end(), vertex) - triangle.begin());
  };
  ForEachEdge(uses, [&](auto first, auto last) {
    for (auto use = first + 1; use != last; ++use)
      for (const int vertex : {first->a, first->b})
        corners.Join(corner_at(first->triangle, vertex), corner_at(use->triangle, vertex));
  });
  std::vector<int> fan(surface.vertices.size(), -1);
  for (int corner = 0; corner < 3 * check.triangles; ++corner) {
    const int vertex = surface.triangles[corner / 3][corner % 3], root = corners.Find(corner);
    if (fan[vertex] < 0) fan[vertex] = root;
    if (fan[vertex] == root || fan[vertex] == -2) continue;
    check.nonmanifold_vertices.Add(surface.vertices[vertex], fan[vertex] / 3, corner / 3);
    fan[vertex] = -2;  // already counted
  }
}

struct Component {
  std::vector<std::array<int, 3>> triangles;
  int first_triangle = -1;
  double volume = 0;
  glm::dvec3 low{0.0}, high{0.0};
};

void CheckComponents(const SurfaceMesh& surface, const std::vector<int>& component_of,
                     SurfaceCheck& check, const Progress& progress) {
  std::vector<Component> components(static_cast<std::size_t>(check.components));
  for (int t = 0; t < check.triangles; ++t) {
    Component& component = components[component_of[t]];
    for (const int corner : surface.triangles[t]) {
      const glm::dvec3& x = surface.vertices[corner];
      const bool is_first = component.first_triangle < 0;
      component.low = is_first ? x : glm::min(component.low, x);
      component.high = is_first ? x : glm::max(component.high, x);
      component.first_triangle = is_first ? t : component.first_triangle;
    }
    component.triangles.push_back(surface.triangles[t]);
  }
  double largest = 0;
  for (Component& component : components) {
    component.volume = SignedVolume(surface.vertices, component.triangles);
    largest = std::max(largest, std::abs(component.volume));
  }
  for (const Component& component : components) {
    progress.Step(kCheckStage, 1.0);
    const int t = component.first_triangle;
    const glm::dvec3 x = surface.vertices[surface.triangles[t][0]];
    if (component.volume < 0) check.inward.Add(x, t);
    if (std::abs(component.volume) < kTinyComponent * largest) check.tiny_components.Add(x, t);
    const auto holds_x = [&](const Component& other) {
      return &other != &component && glm::all(glm::greaterThanEqual(x, other.low)) &&
             glm::all(glm::lessThanEqual(x, other.high)) &&
             std::abs(WindingNumber(surface.vertices, other.triangles, x)) > 0.5;
    };
    const auto outer = std::find_if(components.begin(), components.end(), holds_x);
    if (outer != components.end()) check.cavities.Add(x, t, outer->first_triangle);
  }
}

// Returns a place such as "12.5, 3, -4 mm", with the triangles of the file.
std::string Place(const Finding& finding, const SurfaceSource& source) {
  const glm::dvec3 x = finding.where / source.metres_per_unit;
  std::string place = fmt::format("near {:.6g}, {:.6g}, {:.6g} {}", x.x, x.y, x.z, source.unit);
  // Triangles that a repair added have no number in the file.
  std::vector<int> numbers;
  for (const int t : finding.triangles)
    if (t >= 0) numbers.push_back(source.triangle_in_file.empty() ? t : source.triangle_in_file[t]);
  std::erase(numbers, -1);
  if (numbers.size() == 2)
    place += fmt::format(" (triangles {} and {})", numbers[0], numbers[1]);
  else if (numbers.size() == 1)
    place += fmt::format(" (triangle {})", numbers[0]);
  return place;
}

std::string CountedInWords(int count, const char* one, const char* many) {
  return count == 1 ? fmt::format("one {}", one) : fmt::format("{} {}", count, many);
}

}  // namespace

double SurfaceCheck::Diagonal() const { return glm::distance(low, high); }

SurfaceCheck CheckSurface(const SurfaceMesh& surface, const Progress& progress) {
  SurfaceCheck check;
  check.vertices = static_cast<int>(surface.vertices.size());
  check.triangles = static_cast<int>(surface.triangles.size());
  if (check.vertices > 0) check.low = check.high = surface.vertices[0];
  for (const glm::dvec3& x : surface.vertices) {
    check.low = glm::min(check.low, x);
    check.high = glm::max(check.high, x);
  }
  check.volume = SignedVolume(surface.vertices, surface.triangles);
  const auto uses = SortedEdgeUses(surface);
  const auto component_of = ComponentOfTriangles(surface, uses, &check.components);
  CheckTriangles(surface, check, progress);
  progress.Step(kCheckStage, 0.5);
  CheckEdges(surface, uses, check);
  progress.Step(kCheckStage, 0.8);
  CheckVertices(surface, uses, check);
  if (!check.IsClosedManifold()) return check;
  for (const IntersectingPair& pair : FindSelfIntersections(surface, kMostPairs, progress))
    check.self_intersections.Add(PlaceOf(surface, pair), pair.first, pair.second);
  if (check.flipped.count == 0) CheckComponents(surface, component_of, check, progress);
  return check;
}

void RequireTissueSize(const SurfaceCheck& check, const SurfaceSource& source) {
  const double diagonal = check.Diagonal();
  if (diagonal >= kSmallestTissue && diagonal <= kLargestTissue) return;
  std::string remedy;
  for (const char* unit : {"mm", "m", "um", "cm", "in"}) {
    const double other = diagonal / source.metres_per_unit * *MetresPerUnit(unit);
    if (other < kSmallestTissue || other > kLargestTissue) continue;
    remedy += fmt::format("{}--unit {} ({:.3g} mm)", remedy.empty() ? "" : " or ", unit,
                          MmFromMetres(other));
  }
  throw Error(
      Code::kBadMesh,
      fmt::format("with --unit {} this surface is {:.3g} mm across, and tissues are between "
                  "{:g} and {:g} mm; {}",
                  source.unit, MmFromMetres(diagonal), MmFromMetres(kSmallestTissue),
                  MmFromMetres(kLargestTissue),
                  remedy.empty() ? "scale it where it was made" : "try " + remedy),
      source.file);
}

void RequireMeshable(const SurfaceCheck& check, const SurfaceSource& source) {
  const auto refuse = [&](const Finding& finding, const std::string& fault, const char* remedy) {
    if (finding.count > 0)
      throw Error(Code::kBadMesh,
                  fmt::format("{}, {}{}; {}", fault, finding.count > 1 ? "the first " : "",
                              Place(finding, source), remedy),
                  source.file);
  };
  refuse(check.degenerate,
         "the surface has " + CountedInWords(check.degenerate.count, "triangle", "triangles") +
             " without area",
         "remesh the surface there");
  refuse(check.duplicate,
         "the surface has " +
             CountedInWords(check.duplicate.count, "triangle that is there",
                            "triangles that are there") +
             " twice",
         "delete the copies");
  refuse(check.nonmanifold_edges,
         "more than two triangles meet at " +
             CountedInWords(check.nonmanifold_edges.count, "edge", "edges"),
         "separate the sheets or delete the inner one");
  refuse(
      check.open_edges,
      fmt::format("the surface is open: {} without a neighbour",
                  CountedInWords(check.open_edges.count, "triangle side is", "triangle sides are")),
      "close it where it was made, small holes with --fill-holes, a sheet with --thickness-mm");
  refuse(check.nonmanifold_vertices,
         "two parts of the surface touch at " +
             CountedInWords(check.nonmanifold_vertices.count, "single point", "single points"),
         "move them apart or join them along an edge");
  refuse(check.flipped,
         "the surface has no inside: neighbours face opposite ways at " +
             CountedInWords(check.flipped.count, "edge", "edges"),
         "it is one-sided like a Möbius strip, make it again");
  refuse(
      check.self_intersections,
      "the surface runs through itself at " +
          CountedInWords(check.self_intersections.count, "pair of triangles", "pairs of triangles"),
      "unite or separate the parts where it was made");
  refuse(check.cavities,
         CountedInWords(check.cavities.count, "closed part lies", "closed parts lie") +
             " inside another",
         "delete the inner part");
  if (!(std::abs(check.volume) > 0))
    throw Error(Code::kBadMesh, "the surface encloses no volume", source.file);
}

}  // namespace arthro::authoring
