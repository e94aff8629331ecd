// The deformable models are valid surfaces in the anatomical positions of a meniscus and a layer of
// cartilage.
#include "authoring/phantom/shape/phantom_tissue.h"

#include <cstdio>
#include <map>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "authoring/phantom/look/tissue_caster.h"
#include "authoring/tissue/tetrahedra/tet_quality.h"
#include "simulation/scene/mesh/held_nodes.h"

namespace arthro::authoring {
namespace {

double Volume(const SurfaceMesh& mesh) {
  double six = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    six += glm::dot(mesh.vertices[a], glm::cross(mesh.vertices[b], mesh.vertices[c]));
  return six / 6.0;
}

class EveryTissue : public testing::TestWithParam<int> {
 protected:
  const Cavity cavity = MakeCavity(static_cast<std::uint32_t>(GetParam()));
  const PhantomTissue tissues[2] = {MakeMeniscus(cavity), MakeCartilage(cavity)};
};

TEST_P(EveryTissue, IsClosedManifoldAndOutwardFacing) {
  for (const PhantomTissue& tissue : tissues) {
    std::map<std::pair<int, int>, int> edges;
    for (const auto& t : tissue.surface.triangles)
      for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
    // Each directed edge occurs once and so does its opposite: closed, manifold along edges, one
    // orientation.
    for (const auto& [edge, count] : edges) {
      ASSERT_EQ(count, 1) << tissue.name;
      ASSERT_TRUE(edges.contains({edge.second, edge.first})) << tissue.name;
    }
    const auto v = static_cast<int>(tissue.surface.vertices.size());
    const auto f = static_cast<int>(tissue.surface.triangles.size());
    EXPECT_EQ(v - static_cast<int>(edges.size()) / 2 + f, 2)
        << tissue.name << " is one sphere-like shell";
    EXPECT_GT(Volume(tissue.surface), 0.0) << tissue.name;
    EXPECT_GE(f, 2000);
    EXPECT_LE(f, 6000);
  }
}

TEST_P(EveryTissue, HasTrianglesThatTetGenCanUse) {
  for (const PhantomTissue& tissue : tissues) {
    double smallest_sine = 1.0, shortest = 1.0;
    for (const auto& [a, b, c] : tissue.surface.triangles) {
      const glm::dvec3 p[] = {tissue.surface.vertices[a], tissue.surface.vertices[b],
                              tissue.surface.vertices[c]};
      for (int i = 0; i < 3; ++i) {
        const glm::dvec3 u = p[(i + 1) % 3] - p[i], v = p[(i + 2) % 3] - p[i];
        smallest_sine = std::min(smallest_sine,
                                 glm::length(glm::cross(u, v)) / (glm::length(u) * glm::length(v)));
        shortest = std::min(shortest, glm::length(u));
      }
    }
    std::printf("%s: smallest angle %.1f deg, shortest edge %.3f mm, volume %.0f mm3\n",
                tissue.name.c_str(), std::asin(smallest_sine) * 180 / M_PI, shortest * 1e3,
                Volume(tissue.surface) * 1e9);
    EXPECT_GT(smallest_sine, std::sin(2.0 * M_PI / 180)) << tissue.name;
    EXPECT_GT(shortest, 0.02e-3) << tissue.name;
  }
}

TEST_P(EveryTissue, LiesOnThePlateauUnderTheCondyle) {
  for (const PhantomTissue& tissue : tissues) {
    const SurfaceMesh mesh = InPortal(tissue);
    double under_plateau = 0, into_condyle = 0;
    // Vertices and the middles of triangles.
    const auto probe = [&](const glm::dvec3& x) {
      const glm::dvec3 p = Inverse(cavity.plateau.portal_from_plateau) * x;
      under_plateau = std::max(under_plateau, BoneHeight(cavity.plateau, p.x, p.y) - p.z);
      into_condyle = std::max(into_condyle, -EllipsoidClearance(cavity.condyle, x));
    };
    for (const glm::dvec3& x : mesh.vertices) probe(x);
    for (const auto& [a, b, c] : mesh.triangles)
      probe((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0);
    EXPECT_LT(under_plateau, 0.3e-3) << tissue.name;
    EXPECT_LT(into_condyle, 0.3e-3) << tissue.name;
  }
}

TEST_P(EveryTissue, KeepsClearOfTheOther) {
  const SurfaceMesh a = InPortal(tissues[0]), b = InPortal(tissues[1]);
  double nearest = 1.0;
  for (const glm::dvec3& x : a.vertices)
    for (const glm::dvec3& y : b.vertices) nearest = std::min(nearest, glm::distance(x, y));
  EXPECT_GT(nearest, 0.3e-3);
}

// A side or a gap at the seam is seen as a light lip with dark dashes.
TEST_P(EveryTissue, CartilageCoversTheLipOfItsBedAndEndsInTheBone) {
  const Plateau& plateau = cavity.plateau;
  const SurfaceMesh mesh = InPortal(tissues[1]);
  int over_lip = 0, in_bone = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const glm::dvec3 p = Inverse(plateau.portal_from_plateau) * mesh.vertices[i];
    if (BedShare(plateau.bed, p.x, p.y) < 1.0) continue;
    const bool is_top = i < mesh.vertices.size() / 2;
    const bool is_above = p.z > PlateauHeight(plateau, p.x, p.y);
    over_lip += is_top && is_above;
    in_bone += is_top && !is_above;
    EXPECT_TRUE(is_top || !is_above);
  }
  // Each is a ring of the mesh: the outermost one, and the next.
  EXPECT_EQ(in_bone, 78);
  EXPECT_EQ(over_lip, 72);
}

TEST_P(EveryTissue, MeniscusIsThinAtItsFreeEdgeAndThickAtItsRim) {
  const PhantomTissue& meniscus = tissues[0];
  double highest = 0, highest_edge = 0;
  const SurfaceMesh mesh = InPortal(meniscus);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const glm::dvec3 p = Inverse(cavity.plateau.portal_from_plateau) * mesh.vertices[i];
    const double height = p.z - BoneHeight(cavity.plateau, p.x, p.y);
    highest = std::max(highest, height);
    if (meniscus.rims[i] == 0.0) highest_edge = std::max(highest_edge, height);
  }
  EXPECT_GT(highest, 4.5e-3);
  EXPECT_LT(highest, 7e-3);
  EXPECT_LT(highest_edge, 0.8e-3);
}

TEST_P(EveryTissue, OnlyTheMeniscusIsFilledWithTetrahedraAndHeld) {
  EXPECT_EQ(tissues[0].mesh.order, 2);
  EXPECT_TRUE(tissues[1].mesh.elements.empty());
  EXPECT_TRUE(tissues[1].fixed.empty());
}

// Few enough elements for the display rate, curved as the surface, none of them folded.
TEST_P(EveryTissue, MeniscusIsFilledWithSoundCurvedElements) {
  const TetMesh& mesh = tissues[0].mesh;
  const TetQuality quality = MeasureTets(mesh);
  std::printf(
      "%d elements, %zu nodes, worst det %.2f of straight, dihedral %.1f to %.1f deg, "
      "volume %.1f of %.1f mm3\n",
      mesh.ElementCount(), mesh.rest_positions.size(), quality.worst_jacobian,
      quality.min_dihedral * 180 / M_PI, quality.max_dihedral * 180 / M_PI,
      quality.curved_volume * 1e9, Volume(tissues[0].surface) * 1e9);
  EXPECT_LE(mesh.ElementCount(), 600);
  EXPECT_EQ(quality.inverted, 0);
  EXPECT_GT(quality.worst_jacobian, 0.2);  // 0: folded; 1: straight edges
  EXPECT_GT(quality.min_dihedral, 5.0 * M_PI / 180);
  // The surface has a bevel of 0.5 mm at either horn, which the elements lack.
  EXPECT_NEAR(quality.curved_volume / Volume(tissues[0].surface), 1.0, 0.03);
}

TEST_P(EveryTissue, MeniscusIsHeldAtHornsAndRimAndFreeAtItsEdge) {
  const PhantomTissue& meniscus = tissues[0];
  const std::vector<std::uint8_t> held = HeldNodes(meniscus.surface.vertices, meniscus.fixed);
  int rim = 0, rim_held = 0, edge = 0, edge_held = 0;
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (meniscus.rims[i] == 1.0) ++rim, rim_held += held[i];
    if (meniscus.rims[i] < 0.5) ++edge, edge_held += held[i];
  }
  const std::vector<std::uint8_t> nodes = HeldNodes(meniscus.mesh.rest_positions, meniscus.fixed);
  const auto held_nodes = std::count(nodes.begin(), nodes.end(), 1);
  std::printf("held: %d of %d rim vertices, %d of %d of the inner half, %ld of %zu nodes\n",
              rim_held, rim, edge_held, edge, held_nodes, nodes.size());
  EXPECT_GT(rim_held, rim / 3);    // the lower part, beside the capsule
  EXPECT_LT(edge_held, edge / 8);  // at the horns' roots only
  EXPECT_GT(held_nodes, 100);
  EXPECT_LT(held_nodes, static_cast<long>(nodes.size()) / 3);
  for (const Ball& ball : meniscus.fixed) {
    const std::vector<std::uint8_t> own = HeldNodes(meniscus.mesh.rest_positions, {&ball, 1});
    EXPECT_GT(std::count(own.begin(), own.end(), 1), 0) << "a ball that does nothing";
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, EveryTissue, testing::Values(0, 1, 2, 3, 4, 5, 17, 99));

TEST(TissueCaster, AgreesWithARayThroughEveryTriangle) {
  const Cavity cavity = MakeCavity(1);
  const SurfaceMesh mesh = InPortal(MakeMeniscus(cavity));
  TissueCaster caster;
  caster.Add(mesh, Surface::kMeniscus, {});
  caster.Sort();
  int hits = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 5) {
    const auto& [a, b, c] = mesh.triangles[i];
    const glm::dvec3 d =
        glm::normalize(0.4 * mesh.vertices[a] + 0.35 * mesh.vertices[b] + 0.25 * mesh.vertices[c]);
    // Möller-Trumbore over all triangles.
    double nearest = 1.0;
    for (const auto& [p, q, r] : mesh.triangles) {
      const glm::dvec3 e1 = mesh.vertices[q] - mesh.vertices[p],
                       e2 = mesh.vertices[r] - mesh.vertices[p];
      const glm::dvec3 h = glm::cross(d, e2);
      const double det = glm::dot(e1, h);
      if (std::abs(det) < 1e-18) continue;
      const glm::dvec3 s = -mesh.vertices[p], k = glm::cross(s, e1);
      const double u = glm::dot(s, h) / det, v = glm::dot(d, k) / det, t = glm::dot(e2, k) / det;
      if (u >= 0 && v >= 0 && u + v <= 1 && t > 0) nearest = std::min(nearest, t);
    }
    const auto hit = caster.Cast(d);
    ASSERT_TRUE(hit.has_value());
    EXPECT_NEAR(hit->distance, nearest, 1e-12);
    ++hits;
  }
  EXPECT_GT(hits, 500);
}

}  // namespace
}  // namespace arthro::authoring
