// Fills the crescent with quadratic tetrahedra: a cross-section of eleven triangles, finer towards
// the free edge at which instruments work, swept from horn to horn. Middles of edges lie on the
// formulas of the surface, so elements have the same curvature.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <glm/geometric.hpp>

#include "authoring/phantom/shape/crescent.h"
#include "authoring/phantom/shape/crescent_skin.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

// Place in a cross-section: q from the free edge (0) to the rim (1), t from bottom to top.
struct SectionPoint {
  double q, t;
};
// Two points per column in the thin part of the wedge, three in the thick part.
constexpr std::array<SectionPoint, 12> kSection = {{{0.0, 0.0},
                                                    {0.0, 1.0},
                                                    {0.20, 0.0},
                                                    {0.20, 1.0},
                                                    {0.44, 0.0},
                                                    {0.44, 1.0},
                                                    {0.72, 0.0},
                                                    {0.72, 0.5},
                                                    {0.72, 1.0},
                                                    {1.0, 0.0},
                                                    {1.0, 0.5},
                                                    {1.0, 1.0}}};
constexpr std::array<std::array<int, 3>, 11> kTriangles = {{{0, 2, 1},
                                                            {1, 2, 3},
                                                            {2, 4, 3},
                                                            {3, 4, 5},
                                                            {4, 6, 7},
                                                            {4, 7, 5},
                                                            {5, 7, 8},
                                                            {6, 9, 7},
                                                            {7, 9, 10},
                                                            {7, 10, 11},
                                                            {7, 11, 8}}};
constexpr int kSlices = 18;  // 18 x 11 x 3 = 594 elements, some 2.6 mm long
constexpr int kInSection = static_cast<int>(kSection.size());

struct Parameters {
  double angle, q, t;
};

// Angle of the plane before a slice. The two slices at either horn are shorter, since the wedge
// tapers there.
double AngleOf(const Crescent& c, int slice) {
  constexpr double kShort = 0.55;
  const auto ends = [](int n) { return kShort * std::min(n, 2) + std::max(n - 2, 0); };
  const double all = 4.0 * kShort + kSlices - 4;
  const double passed = slice <= kSlices / 2 ? ends(slice) : all - ends(kSlices - slice);
  return c.from + (c.to - c.from) * passed / all;
}

Parameters CornerOf(const Crescent& c, int node) {
  const int slice = node / kInSection;
  const SectionPoint& s = kSection[static_cast<std::size_t>(node % kInSection)];
  return {AngleOf(c, slice), s.q, s.t};
}

double SixVolumes(const std::vector<glm::dvec3>& x, const std::array<int, 4>& e) {
  return glm::dot(glm::cross(x[e[1]] - x[e[0]], x[e[2]] - x[e[0]]), x[e[3]] - x[e[0]]);
}

// Splits each prism between two slices into three tetrahedra. A prism takes its corners in the
// order of their numbers, so that neighbours agree on the diagonal between them. Every second slice
// reverses the order, so that no direction is stiffer.
std::vector<std::array<int, 4>> CornersOfElements(const std::vector<glm::dvec3>& x) {
  std::vector<std::array<int, 4>> elements;
  for (int slice = 0; slice < kSlices; ++slice)
    for (std::array<int, 3> triangle : kTriangles) {
      std::sort(triangle.begin(), triangle.end());
      const bool is_turned = slice % 2 == 1;
      const int low = (slice + (is_turned ? 1 : 0)) * kInSection;
      const int high = (slice + (is_turned ? 0 : 1)) * kInSection;
      const auto [a, b, c] = triangle;
      for (std::array<int, 4> element : {std::array{low + a, low + b, low + c, high + c},
                                         std::array{low + a, low + b, high + b, high + c},
                                         std::array{low + a, high + a, high + b, high + c}}) {
        if (SixVolumes(x, element) < 0) std::swap(element[0], element[1]);
        elements.push_back(element);
      }
    }
  return elements;
}

}  // namespace

glm::dvec3 PlaceInCrescent(const Crescent& c, const CrescentGround& ground, double angle, double q,
                           double t) {
  const Wedge wedge = WedgeAt(c, angle);
  const double bottom = c.film, top = TopOf(c, wedge, q);
  // The bulge of the rim decreases inwards, so that elements beside it keep their shape.
  const double share = std::max(0.0, (q - 0.72) / 0.28);
  const double r = OuterRadius(c, angle) - (1.0 - q) * wedge.width + share * RimBulge(wedge, t);
  return ground(angle, r, bottom + t * (top - bottom));
}

void FillMeniscus(const Cavity& cavity, const Crescent& c, PhantomTissue& tissue) {
  const Rigid3 tissue_from_plateau = Inverse(c.plateau_from_tissue);
  const CrescentGround ground = [&](double angle, double r, double lift) {
    return OnPlateau(cavity, c, angle, r, lift);
  };
  const auto place = [&](const Parameters& p) {
    return tissue_from_plateau * PlaceInCrescent(c, ground, p.angle, p.q, p.t);
  };
  TetMesh& mesh = tissue.mesh;
  mesh.order = 2;
  for (int node = 0; node < (kSlices + 1) * kInSection; ++node)
    mesh.rest_positions.push_back(place(CornerOf(c, node)));

  // Curved on the surface; straight inside, since a curve there would only distort elements.
  const auto middle_of = [&](const std::pair<int, int>& edge) {
    const Parameters u = CornerOf(c, edge.first), v = CornerOf(c, edge.second);
    const bool is_outside =
        (u.t == v.t && (u.t == 0.0 || u.t == 1.0)) || (u.q == v.q && (u.q == 0.0 || u.q == 1.0));
    return is_outside ? place({0.5 * (u.angle + v.angle), 0.5 * (u.q + v.q), 0.5 * (u.t + v.t)})
                      : 0.5 * (mesh.rest_positions[static_cast<std::size_t>(edge.first)] +
                               mesh.rest_positions[static_cast<std::size_t>(edge.second)]);
  };
  constexpr std::array<std::array<int, 2>, 6> kEdges = {
      {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  std::map<std::pair<int, int>, int> middles;
  for (const std::array<int, 4>& element : CornersOfElements(mesh.rest_positions)) {
    mesh.elements.insert(mesh.elements.end(), element.begin(), element.end());
    for (const auto& [i, j] : kEdges) {
      const std::pair<int, int> edge = std::minmax(element[i], element[j]);
      const auto [entry, is_new] =
          middles.emplace(edge, static_cast<int>(mesh.rest_positions.size()));
      if (is_new) {
        mesh.rest_positions.push_back(middle_of(edge));
      }
      mesh.elements.push_back(entry->second);
    }
  }

  tissue.fixed = HoldsOf(c, [&](double angle, double q, double t) { return place({angle, q, t}); });
}

std::vector<Ball> HoldsOf(const Crescent& c, const CrescentPlace& place) {
  std::vector<Ball> fixed;
  // Fixed as in the knee: the horns at their roots, the rim along the capsule. The balls of the rim
  // are centred outside and reach in by 1 mm.
  const auto hold = [&](const glm::dvec3& centre, double radius) {
    constexpr double kStep = 1e-5;  // m, resolution of the file
    fixed.push_back({glm::round(centre / kStep) * kStep, radius});
  };
  for (const double angle : {c.from, c.to}) hold(place(angle, 0.5, 0.5), 2.2 * kMm);
  constexpr int kRimBalls = 22;
  constexpr double kFromHorn = 0.4;  // rad, length of the roots
  constexpr double kRadius = 2.5 * kMm, kReach = 1.0 * kMm;
  for (int i = 0; i < kRimBalls; ++i) {
    const double share = (i + 0.5) / kRimBalls;
    const double angle = c.from + kFromHorn + share * (c.to - c.from - 2.0 * kFromHorn);
    const glm::dvec3 rim = place(angle, 1.0, 0.3);
    const glm::dvec3 inwards = place(angle, 0.9, 0.3) - rim;
    const glm::dvec3 level = glm::normalize(glm::dvec3(inwards.x, inwards.y, 0.0));
    hold(rim - (kRadius - kReach) * level, kRadius);
  }
  return fixed;
}

}  // namespace arthro::authoring
