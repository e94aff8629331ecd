#include "authoring/tissue/tetrahedra/tetrahedralize.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "authoring/tissue/surface/surface_topology.h"
#include "simulation/core/error.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/build_paths.h"
#include "tests/support/gmsh_outside.h"
#include "tests/support/shapes.h"
#include "tests/support/shared_data.h"

namespace arthro::authoring {
namespace {

using test::Box;
using test::Sphere;
using test::Together;

const SurfaceMesh kBox = Box({0, 0, 0}, {0.01, 0.02, 0.03});

TetMesh Fill(const SurfaceMesh& surface, const TetrahedralizeOptions& options = {},
             TetrahedralizeReport* report = nullptr, const SurfaceSource& source = {}) {
  return Tetrahedralize(surface, source, options, report, {}, ARTHRO_PROGRAM);
}

TetrahedralizeOptions WithOrder(int order, double max_edge = 0) {
  TetrahedralizeOptions options;
  options.order = order;
  options.max_edge = max_edge;
  return options;
}

TEST(Tetrahedralize, VolumeEqualsThatOfTheSurface) {
  // The elements fill the very triangles, so only rounding is left; 1e-6 is the requirement.
  for (const SurfaceMesh& surface :
       {kBox, Sphere({0.1, 0, -0.1}, 0.015, 3), test::Torus(0.02, 0.006, 40, 16),
        Together(kBox, Sphere({0.04, 0, 0}, 0.01, 2))})
    for (const double max_edge : {0.0, 0.003}) {
      TetrahedralizeReport report;
      Fill(surface, WithOrder(1, max_edge), &report);
      std::printf(
          "%5zu triangles, edge %g: %6d elements, volume off by %.1e, angles %.1f to %.1f\n",
          surface.triangles.size(), max_edge, report.elements, report.volume_error,
          report.quality.min_dihedral * 57.29578, report.quality.max_dihedral * 57.29578);
      EXPECT_LT(report.volume_error, 1e-6);
      EXPECT_EQ(report.quality.inverted, 0);
      EXPECT_EQ(report.attempts.front().result, "done");
    }
}

TEST(Tetrahedralize, SurfaceVerticesComeFirstAndUnmoved) {
  const SurfaceMesh sphere = Sphere({0.1, 0.2, 0.3}, 0.015, 2);
  for (const int order : {1, 2}) {
    const TetMesh mesh = Fill(sphere, WithOrder(order));
    ASSERT_GE(mesh.rest_positions.size(), sphere.vertices.size());
    for (std::size_t i = 0; i < sphere.vertices.size(); ++i)
      EXPECT_EQ(mesh.rest_positions[i], sphere.vertices[i]) << i;
  }
}

TEST(Tetrahedralize, MidNodesOfQuadraticElementsAreInVtksOrder) {
  const TetMesh mesh = Fill(Sphere({0, 0, 0}, 0.015, 2), WithOrder(2, 0.006));
  ASSERT_EQ(mesh.order, 2);
  ASSERT_GT(mesh.ElementCount(), 50);
  const std::array<std::array<int, 2>, 6> edges = {
      {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  double worst = 0;
  for (int i = 0; i < mesh.ElementCount(); ++i) {
    const int* node = &mesh.elements[10 * i];
    for (int k = 0; k < 6; ++k) {
      const glm::dvec3 middle =
          0.5 * (mesh.rest_positions[node[edges[k][0]]] + mesh.rest_positions[node[edges[k][1]]]);
      worst = std::max(worst, glm::distance(middle, mesh.rest_positions[node[4 + k]]));
    }
  }
  std::printf("worst distance of a mid node from the middle of its edge: %.1e m\n", worst);
  EXPECT_LT(worst, 1e-15) << "rounding of coordinates of 0.015 m";
  // Neighbours share the nodes on their common edges.
  std::set<std::pair<int, int>> edge_set;
  for (int i = 0; i < mesh.ElementCount(); ++i)
    for (const auto& [a, b] : edges)
      edge_set.insert(std::minmax(mesh.elements[10 * i + a], mesh.elements[10 * i + b]));
  std::set<int> corners;
  for (int i = 0; i < mesh.ElementCount(); ++i)
    for (int k = 0; k < 4; ++k) corners.insert(mesh.elements[10 * i + k]);
  EXPECT_EQ(mesh.rest_positions.size(), corners.size() + edge_set.size());
}

TEST(Tetrahedralize, NoEdgeIsLongerThanTheLimit) {
  for (const double max_edge : {0.005, 0.002, 0.0012}) {
    TetrahedralizeReport report;
    Fill(kBox, WithOrder(1, max_edge), &report);
    std::printf("asked for %.4g mm: longest %.4g, median %.4g, %d elements\n", max_edge * 1e3,
                report.quality.longest_edge * 1e3, report.quality.median_edge * 1e3,
                report.elements);
    EXPECT_LE(report.quality.longest_edge, max_edge);
    // Not much finer than needed: the median edge of a good mesh is over a third of the limit.
    EXPECT_GT(report.quality.median_edge, max_edge / 3);
  }
}

TEST(Tetrahedralize, SurfaceSetHoldsOnlyOuterNodes) {
  for (const int order : {1, 2}) {
    const TetMesh mesh = Fill(kBox, WithOrder(order, 0.004));
    const auto& surface = mesh.sets.at("surface");
    int inside = 0;
    for (std::size_t i = 0; i < mesh.rest_positions.size(); ++i) {
      const glm::dvec3 x = mesh.rest_positions[i], high{0.01, 0.02, 0.03};
      double distance = 1;  // from the nearest face
      for (int axis = 0; axis < 3; ++axis)
        distance = std::min({distance, x[axis], high[axis] - x[axis]});
      EXPECT_EQ(surface[i], distance < 1e-12) << "node " << i << " at distance " << distance;
      inside += surface[i] == 0;
    }
    EXPECT_GT(inside, 5);
  }
}

TEST(Tetrahedralize, SameInputGivesTheSameMesh) {
  const SurfaceMesh torus = test::Torus(0.02, 0.006, 40, 16);
  const TetMesh first = Fill(torus, WithOrder(2, 0.003)), second = Fill(torus, WithOrder(2, 0.003));
  EXPECT_EQ(first.rest_positions, second.rest_positions);
  EXPECT_EQ(first.elements, second.elements);
  EXPECT_EQ(first.sets, second.sets);
}

TEST(Tetrahedralize, ElementsHaveTheRequiredQuality) {
  TetrahedralizeReport report;
  Fill(Sphere({0, 0, 0}, 0.015, 3), {}, &report);
  std::printf("dihedral %.2f to %.2f degrees, radius over edge %.2f, relative volume %.1e\n",
              report.quality.min_dihedral * 57.29578, report.quality.max_dihedral * 57.29578,
              report.quality.worst_radius_edge, report.quality.worst_relative_volume);
  EXPECT_GT(report.quality.min_dihedral, 9.9 / 57.29578) << "the default asks for ten degrees";
  EXPECT_GT(report.quality.worst_relative_volume, 1e-3);
}

TEST(Tetrahedralize, QualityOfKnownTetrahedraIsCorrect) {
  TetMesh regular;
  regular.rest_positions = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  regular.elements = {0, 1, 2, 3};
  if (MeasureTets(regular).volume < 0) std::swap(regular.elements[0], regular.elements[1]);
  const TetQuality quality = MeasureTets(regular);
  EXPECT_DOUBLE_EQ(quality.volume, 8.0 / 3);
  EXPECT_NEAR(quality.min_dihedral, std::acos(1.0 / 3), 1e-14);
  EXPECT_NEAR(quality.max_dihedral, std::acos(1.0 / 3), 1e-14);
  EXPECT_NEAR(quality.worst_radius_edge, std::sqrt(6.0) / 4, 1e-14);
  EXPECT_NEAR(quality.worst_relative_volume, std::sqrt(2.0) / 12, 1e-14);
  TetMesh corner;
  corner.rest_positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  corner.elements = {0, 1, 2, 3};
  EXPECT_NEAR(MeasureTets(corner).max_dihedral, std::acos(0.0), 1e-14);
  EXPECT_NEAR(MeasureTets(corner).min_dihedral, std::acos(1 / std::sqrt(3.0)), 1e-14);
}

TEST(Tetrahedralize, RepairsAreReported) {
  SurfaceMesh surface = test::InsideOut(kBox);
  surface.triangles.push_back(surface.triangles[0]);
  TetrahedralizeReport report;
  Fill(surface, {}, &report);
  const auto json = nlohmann::json::parse(ReportText(report, {}, {}));
  EXPECT_EQ(json["schema"], "arthroscene.tetrahedralize/1");
  EXPECT_EQ(json["repairs"]["flipped_components"], 1);
  EXPECT_EQ(json["repairs"]["duplicate_triangles"], 1);
  EXPECT_EQ(json["elements"], report.elements);
}

TEST(Tetrahedralize, TooManyElementsAreRefusedBeforeMeshing) {
  try {
    Fill(kBox, WithOrder(1, 1e-5));
    FAIL() << "6000 mm3 in edges of 0.01 mm were begun with";
  } catch (const Error& error) {
    EXPECT_NE(error.sentence().find("--max-edge-mm 0."), std::string::npos) << error.sentence();
  }
}

TEST(Tetrahedralize, RealMeniscusIsFilled) {
  ARTHRO_REQUIRE_SHARED(file, "data/meniscus_lateral_tet/lateralMeniscusComputationModelSTP.msh");
  SurfaceMesh meniscus = test::OutsideOfGmsh(file);
  ASSERT_GT(meniscus.triangles.size(), 300u);
  for (glm::dvec3& x : meniscus.vertices)
    x *= 0.02;  // about 1.9 of a unit that the file does not name
  for (const double max_edge : {0.0, 0.004}) {
    TetrahedralizeReport report;
    Fill(meniscus, WithOrder(2, max_edge), &report);
    std::printf(
        "meniscus, edge %g: %d elements, %d nodes, volume off by %.1e, angles %.1f to %.1f\n",
        max_edge, report.elements, report.nodes, report.volume_error,
        report.quality.min_dihedral * 57.29578, report.quality.max_dihedral * 57.29578);
    EXPECT_LT(report.volume_error, 1e-6);
  }
}

TEST(Tetrahedralize, RealBoneOf17308TrianglesIsFilled) {
  ARTHRO_REQUIRE_SHARED(file, "data/knee_cartilage_jam/lenhart2015-R-patella-bone.stl");
  TetrahedralizeReport report;
  Fill(ReadSurface(file, 1.0), {}, &report);
  std::printf("patella: %d elements, volume off by %.1e, angles %.1f to %.1f, %.0f + %.0f ms\n",
              report.elements, report.volume_error, report.quality.min_dihedral * 57.29578,
              report.quality.max_dihedral * 57.29578, report.check_ms, report.mesh_ms);
  EXPECT_LT(report.volume_error, 1e-6);
}

TEST(Tetrahedralize, SheetBecomesALayerOfTheGivenThickness) {
  // The upper half of a sphere of 15 mm, as a sheet; its layer lies between two half spheres.
  SurfaceMesh cap = Sphere({0, 0, 0}, 0.015, 4);
  std::erase_if(cap.triangles, [&](const auto& triangle) {
    return cap.vertices[triangle[0]].z + cap.vertices[triangle[1]].z + cap.vertices[triangle[2]].z <
           0;
  });
  for (const double thickness : {0.002, -0.002}) {
    TetrahedralizeOptions options;
    options.thickness = thickness;
    TetrahedralizeReport report;
    Fill(cap, options, &report);
    const double other = 0.015 - thickness;
    const double layer =
        2.0 / 3 * std::numbers::pi * std::abs(std::pow(0.015, 3) - std::pow(other, 3));
    std::printf("layer of %g m: volume %.5g, half shell %.5g\n", thickness, report.quality.volume,
                layer);
    EXPECT_EQ(report.thickened_parts, 1);
    // 2048 triangles on the sphere have 0.5 % less area than it, their shell 0.5 % less volume.
    EXPECT_NEAR(report.quality.volume, layer, 0.01 * layer);
  }
}

TEST(Tetrahedralize, RealTibialCartilageBecomesTwoLayers) {
  ARTHRO_REQUIRE_SHARED(file, "data/knee_cartilage_jam/lenhart2015-R-tibia-cartilage.stl");
  TetrahedralizeOptions options;
  options.thickness = 0.002;
  options.max_triangles = 3000;  // all 18 thousand make 283268 elements in ten seconds
  TetrahedralizeReport report;
  Fill(ReadSurface(file, 1.0), options, &report, {file, "m", 1.0, {}});
  std::printf("tibia: %d elements, %.0f mm3, volume off by %.1e, angles %.1f to %.1f, %.0f ms\n",
              report.elements, report.quality.volume * 1e9, report.volume_error,
              report.quality.min_dihedral * 57.29578, report.quality.max_dihedral * 57.29578,
              report.mesh_ms);
  EXPECT_EQ(report.thickened_parts, 2) << "two plateaus";
  EXPECT_EQ(report.surface.components, 2);
  EXPECT_LT(report.volume_error, 1e-6);
}

TEST(Tetrahedralize, RealTibialCartilageIsSimplifiedForDisplayRate) {
  ARTHRO_REQUIRE_SHARED(file, "data/knee_cartilage_jam/lenhart2015-R-tibia-cartilage.stl");
  TetrahedralizeOptions options;
  options.thickness = 0.002;
  options.max_triangles = 600;
  options.radius_edge = 3;
  options.min_dihedral = 0;
  TetrahedralizeReport report;
  Fill(ReadSurface(file, 1.0), options, &report, {file, "m", 1.0, {}});
  std::printf("tibia: %d triangles, at most %.2g mm off: %d elements, angles %.1f to %.1f\n",
              report.simplification.triangles_after, report.simplification.largest_distance * 1e3,
              report.elements, report.quality.min_dihedral * 57.29578,
              report.quality.max_dihedral * 57.29578);
  EXPECT_LE(report.simplification.triangles_after, 600);
  EXPECT_LT(report.simplification.largest_distance, 1e-3) << "half its thickness";
  EXPECT_LT(report.elements, 10000) << "of 283268 without";
}

TEST(Tetrahedralize, RealJointSurfaceIsRefusedAsOpen) {
  ARTHRO_REQUIRE_SHARED(file, "data/knee_cartilage_jam/lenhart2015-R-tibia-cartilage.stl");
  try {
    Fill(ReadSurface(file, 1.0), {}, nullptr, {file, "m", 1.0, {}});
    FAIL() << "the file holds the joint surface only, without a back";
  } catch (const Error& error) {
    EXPECT_NE(error.sentence().find("open: 300 triangle sides"), std::string::npos)
        << error.sentence();
  }
}

}  // namespace
}  // namespace arthro::authoring
