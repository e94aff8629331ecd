#include "app/view/drawing/strands.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "simulation/core/random.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

constexpr double kPlaceStep = 1e-5;  // m; places at rest are told apart by it
constexpr int kSides = 3;
constexpr int kRings = 4;  // below the tip

// Frayed fibres.
constexpr double kFrayed = 9e6;          // 1/m^2, of a face across the fibres at full strength
constexpr double kAlongFibres = 0.5;     // share of that on a face along the fibres
constexpr double kFrayLength = 0.45e-3;  // m, half to once and a half of it
constexpr double kFrayRadius = 0.27;     // widths of a fibre bundle
// Shares of the fibres, of the face's normal and of chance in the direction of a strand.
constexpr double kFrayLean = 0.6, kFrayOut = 0.6, kFrayAside = 0.4;
constexpr double kMeetsFibres = 0.15;  // sine of the angle between face and fibres
constexpr double kFrayBend = 0.9;
constexpr double kFraySway = 0.06;  // share of the length

// Villi.
constexpr double kVilli = 2.5e6;           // 1/m^2 at full strength
constexpr double kVillusLength = 1.3e-3;   // m, half to once and a half of it
constexpr double kVillusRadius = 0.11e-3;  // m
constexpr double kVillusBend = 0.7;
constexpr double kVillusSway = 0.22;  // share of the length

// Light passes through a strand: its normals lean towards that of the surface by this share.
constexpr double kTranslucent = 0.6;

// Slow eddies of the inflow.
constexpr double kSlowest = 0.25, kFastest = 0.6;  // Hz

// Returns the frame of a triangle: along its first side, in its plane, outwards. A triangle without
// an area gives zeros.
glm::dmat3 FrameOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 twice = glm::cross(b - a, c - a), side = b - a;
  const double area = glm::length(twice), length = glm::length(side);
  if (!(area > 0.0) || !(length > 0.0)) return glm::dmat3(0.0);
  const glm::dvec3 along = side / length, out = twice / area;
  return {along, glm::cross(out, along), out};
}

glm::dvec3 UnitOr(const glm::dvec3& x, const glm::dvec3& otherwise) {
  const double length = glm::length(x);
  return length > 0.0 ? x / length : otherwise;
}

Random NumbersOf(const glm::dvec3& place, std::uint64_t kind) {
  std::uint64_t seed = kind;
  for (int c = 0; c < 3; ++c)
    seed = seed * 0x9E3779B97F4A7C15ull +
           static_cast<std::uint64_t>(std::llround(place[c] / kPlaceStep));
  return Random(seed);
}

// Grows strands on the triangles for which `density` (1/m^2) is positive, and fewer everywhere
// where that would be too many. `shape` completes one.
template <class Density, class Shape>
std::vector<Strand> Grow(const SurfaceMesh& surface, std::uint64_t kind, const Density& density,
                         const Shape& shape) {
  const auto corner = [&](const std::array<int, 3>& t, std::size_t i) {
    return surface.vertices[static_cast<std::size_t>(t[i])];
  };
  std::vector<double> expected;  // strands per triangle
  double all = 0;
  for (const auto& t : surface.triangles) {
    const glm::dvec3 a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
    const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
    expected.push_back(area > 0.0 ? area * density(t, FrameOf(a, b, c)) : 0.0);
    all += expected.back();
  }
  const double share = std::min(1.0, static_cast<double>(kMostStrands) / std::max(all, 1.0));
  std::vector<Strand> strands;
  for (std::size_t at = 0; at < expected.size(); ++at) {
    if (!(expected[at] > 0.0)) continue;
    const auto& t = surface.triangles[at];
    const glm::dvec3 a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
    Random own = NumbersOf((a + b + c) / 3.0, kind);
    const auto count = static_cast<std::size_t>(share * expected[at] + own.Uniform(0.0, 1.0));
    for (std::size_t i = 0; i < count; ++i) {
      Strand strand;
      strand.corners = t;
      const double u = std::sqrt(own.Uniform(0.0, 1.0)), v = own.Uniform(0.0, 1.0);
      strand.root = {1.0 - u, u * (1.0 - v), u * v};
      strand.phase = own.Uniform(0.0, kRadianPerTurn);
      strand.rate = kRadianPerTurn * own.Uniform(kSlowest, kFastest);
      shape(t, FrameOf(a, b, c), own, strand);
      strands.push_back(strand);
    }
  }
  return strands;
}

glm::dvec3 Aside(Random& own) {
  const double angle = own.Uniform(0.0, kRadianPerTurn);
  return {std::cos(angle), std::sin(angle), 0.0};
}

}  // namespace

std::vector<Strand> FrayedFibres(const SurfaceMesh& surface, std::span<const std::uint8_t> fresh,
                                 const TissueGrain& grain, const simulation::TissueLook& look) {
  if (fresh.empty() || !(look.fraying > 0.0)) return {};
  const auto along = [&](const std::array<int, 3>& t) {
    return grain.Along(surface.vertices[static_cast<std::size_t>(t[0])]);
  };
  const auto density = [&](const std::array<int, 3>& t, const glm::dmat3& frame) {
    for (const int v : t)
      if (fresh[static_cast<std::size_t>(v)] == 0) return 0.0;
    const double across = std::abs(glm::dot(along(t), frame[2]));
    return look.fraying * kFrayed * (kAlongFibres + (1.0 - kAlongFibres) * across);
  };
  const auto shape = [&](const std::array<int, 3>& t, const glm::dmat3& frame, Random& own,
                         Strand& strand) {
    // A bundle leaves the face along the fibres, on the side where the cut has opened it.
    const glm::dvec3 fibre = glm::transpose(frame) * along(t);
    const double side = std::abs(fibre.z) > kMeetsFibres
                            ? (fibre.z < 0.0 ? -1.0 : 1.0)
                            : (own.Uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0);
    strand.way = glm::normalize(glm::dvec3(0, 0, kFrayOut) + kFrayLean * side * fibre +
                                kFrayAside * Aside(own));
    strand.bend = own.Uniform(0.3, 1.0) * kFrayBend * Aside(own);
    strand.length = kFrayLength * own.Near(1.0, 0.5);
    strand.radius = look.fibre_width * kFrayRadius * own.Near(1.0, 0.4);
    strand.sway = kFraySway * strand.length;
  };
  return Grow(surface, 1, density, shape);
}

std::vector<Strand> Villi(const SurfaceMesh& surface, const simulation::TissueLook& look) {
  if (!(look.villi > 0.0)) return {};
  const auto density = [&](const std::array<int, 3>&, const glm::dmat3&) {
    return look.villi * kVilli;
  };
  const auto shape = [&](const std::array<int, 3>&, const glm::dmat3&, Random& own,
                         Strand& strand) {
    strand.way = glm::normalize(glm::dvec3(0, 0, 1) + 0.5 * Aside(own));
    strand.bend = own.Uniform(0.2, 1.0) * kVillusBend * Aside(own);
    strand.length = kVillusLength * own.Near(1.0, 0.5);
    strand.radius = kVillusRadius * own.Near(1.0, 0.35);
    strand.sway = kVillusSway * strand.length;
  };
  return Grow(surface, 2, density, shape);
}

StrandMesh MeshOf(std::span<const Strand> strands, std::span<const glm::dvec3> positions,
                  double time) {
  StrandMesh mesh;
  mesh.surface.vertices.reserve(strands.size() * (kSides * kRings + 1));
  mesh.normals.reserve(mesh.surface.vertices.capacity());
  for (const Strand& strand : strands) {
    const glm::dvec3 &a = positions[static_cast<std::size_t>(strand.corners[0])],
                     &b = positions[static_cast<std::size_t>(strand.corners[1])],
                     &c = positions[static_cast<std::size_t>(strand.corners[2])];
    const glm::dmat3 frame = FrameOf(a, b, c);
    const glm::dvec3 root = strand.root.x * a + strand.root.y * b + strand.root.z * c;
    const glm::dvec3 way = frame * strand.way, bend = frame * strand.bend;
    const glm::dvec3 flow =
        frame * glm::dvec3(std::sin(strand.rate * time + strand.phase),
                           std::cos(0.7 * strand.rate * time + 1.7 * strand.phase), 0.0);
    // Two directions across the strand. The frame is that of a surface, so that one of its first
    // two axes is never along it.
    const glm::dvec3 aside = std::abs(strand.way.x) < 0.7 ? frame[0] : frame[1];
    const glm::dvec3 right = UnitOr(glm::cross(way, aside), aside), up = glm::cross(way, right);
    const auto first = static_cast<int>(mesh.surface.vertices.size());
    const auto axis_at = [&](double share) {
      return root + strand.length * share * (way + 0.5 * share * bend) +
             share * share * strand.sway * flow;
    };
    for (int ring = 0; ring < kRings; ++ring) {
      const double share = static_cast<double>(ring) / kRings;
      // The lowest ring lies below the surface, so that no gap is seen.
      const glm::dvec3 middle = ring == 0 ? root - strand.radius * way : axis_at(share);
      const double radius = strand.radius * std::sqrt(1.0 - share * share * share);
      for (int side = 0; side < kSides; ++side) {
        const double angle = kRadianPerTurn * side / kSides;
        const glm::dvec3 out = std::cos(angle) * right + std::sin(angle) * up;
        mesh.surface.vertices.push_back(middle + radius * out);
        mesh.normals.push_back(UnitOr(glm::mix(out, frame[2], kTranslucent), out));
      }
    }
    mesh.surface.vertices.push_back(axis_at(1.0));
    mesh.normals.push_back(UnitOr(glm::mix(UnitOr(way + bend, way), frame[2], kTranslucent), way));
    const int tip = first + kSides * kRings;
    mesh.surface.triangles.push_back({first, first + 2, first + 1});
    for (int ring = 0; ring < kRings; ++ring)
      for (int side = 0; side < kSides; ++side) {
        const int next = (side + 1) % kSides, low = first + kSides * ring;
        if (ring + 1 == kRings) {
          mesh.surface.triangles.push_back({low + side, low + next, tip});
          continue;
        }
        mesh.surface.triangles.push_back({low + side, low + next, low + kSides + next});
        mesh.surface.triangles.push_back({low + side, low + kSides + next, low + kSides + side});
      }
  }
  return mesh;
}

}  // namespace arthro::app
