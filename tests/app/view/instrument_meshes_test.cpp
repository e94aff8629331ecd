// Meshes of the instruments as they are drawn, against their contact shapes and real shafts.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/view/instruments/probe_mesh.h"
#include "app/view/instruments/tool_mesh.h"
#include "app/view/instruments/tool_shade.h"
#include "app/view/shaders/constants.h"
#include "simulation/scene/mesh/vertex_normals.h"
#include "tests/app/view/view_scene.h"

namespace arthro::test {
namespace {

using app::InstrumentView;
using app::Picture;
using app::PictureFromPose;

// Signed distance of a place to the nearest of some capsules, m.
double OffCapsules(const glm::dvec3& x, std::span<const simulation::Capsule> capsules) {
  double least = 1;
  for (const simulation::Capsule& c : capsules) {
    const glm::dvec3 way = c.b - c.a;
    const double t = std::clamp(glm::dot(x - c.a, way) / glm::dot(way, way), 0.0, 1.0);
    least = std::min(least, glm::distance(x, c.a + t * way) - c.radius);
  }
  return least;
}

constexpr simulation::ToolKind kEveryTool[] = {
    simulation::ToolKind::kProbe, simulation::ToolKind::kPunch, simulation::ToolKind::kShaver,
    simulation::ToolKind::kGrasper};

// Two capsules make one hook where they share an end; the rod's own round end beyond it would be a
// second lobe of the shadow.
TEST(ToolShade, TheRodOfAProbeEndsAsItsHookBegins) {
  const simulation::ToolShape shape = simulation::ShapeOf(simulation::ToolKind::kProbe);
  Picture picture = PictureFromPose({0.1, -0.2, 0.3, 0.012}, 0.5, 1.4);
  picture.instrument = InstrumentView{
      {0.03, 0.0, 0.0}, {0.004, 0.006, 0.03}, 0.7, simulation::ToolKind::kProbe, 0.0};
  const app::LensShade shade = app::ShadeOf(picture, shape);
  EXPECT_EQ(shade.rod.to, shade.head.from);
  EXPECT_NEAR(shade.rod.radius * (1 - app::kRodTaper), shade.head.radius, 1e-12);
  EXPECT_NEAR(glm::distance(shade.head.from, shade.head.to),
              glm::distance(shape.capsules[0].a, shape.capsules[0].b), 1e-12);
}

// The drawn shape agrees with the contact shape. Capsules are round where real jaws are flat, with
// edges; nothing is drawn more than 0.45 mm off them. The tips, which a trainee works with, are
// within 0.2 mm: along the rod, and each jaw's from its hinge.
TEST(ToolMesh, AgreesWithTheContactShape) {
  using namespace simulation;
  for (const ToolKind kind : kEveryTool) {
    const ToolShape shape = ShapeOf(kind);
    const app::ToolMesh mesh = app::MakeToolMesh(kind);
    for (const double opening : {0.0, 0.4, 1.0}) {
      std::vector<Capsule> capsules(shape.capsules.size());
      PosedCapsules(shape, {true, {}, opening, false}, capsules);
      const Pose part = app::MovingPart(mesh, mesh.turns_freely ? 0.0 : opening, 0.0);
      double far_off = 0, drawn_tip = -1, touching_tip = -1, drawn_jaw = 0, touching_jaw = 0;
      const auto see = [&](const glm::dvec3& x) {
        // The working end; shafts are drawn slightly longer than their contact shapes.
        if (x.z > -30e-3) far_off = std::max(far_off, OffCapsules(x, capsules));
        drawn_tip = std::max(drawn_tip, x.z);
      };
      for (const glm::dvec3& x : mesh.body.vertices) see(x);
      for (const glm::dvec3& x : mesh.moving.vertices) {
        see(part * x);
        drawn_jaw = std::max(drawn_jaw, glm::distance(part * x, mesh.hinge));
      }
      for (std::size_t i = 0; i < capsules.size(); ++i) {
        const Capsule& c = capsules[i];
        touching_tip = std::max(touching_tip, std::max(c.a.z, c.b.z) + c.radius);
        if (std::ranges::count(shape.jaw, static_cast<int>(i)) > 0)
          touching_jaw = std::max(touching_jaw, glm::distance(c.b, mesh.hinge) + c.radius);
      }
      std::printf("tool %d, opening %.1f: tip %+.3f mm, jaw %+.3f mm, at most %.3f mm outside\n",
                  static_cast<int>(kind), opening, 1e3 * (drawn_tip - touching_tip),
                  1e3 * (touching_jaw > 0 ? drawn_jaw - touching_jaw : 0.0), 1e3 * far_off);
      EXPECT_NEAR(drawn_tip, touching_tip, 0.2e-3) << static_cast<int>(kind);
      if (touching_jaw > 0) {
        EXPECT_NEAR(drawn_jaw, touching_jaw, 0.2e-3) << static_cast<int>(kind);
      }
      EXPECT_LT(far_off, 0.45e-3) << static_cast<int>(kind);
    }
  }
}

// Every edge has its opposite once the copies of a place (at a sharp edge of the metal) are merged.
bool IsClosed(const SurfaceMesh& mesh) {
  std::map<std::array<long, 3>, int> places;
  std::vector<int> place;
  for (const glm::dvec3& v : mesh.vertices)
    place.push_back(places
                        .emplace(std::array{std::lround(v.x * 1e9), std::lround(v.y * 1e9),
                                            std::lround(v.z * 1e9)},
                                 static_cast<int>(places.size()))
                        .first->second);
  std::map<std::pair<int, int>, int> balance;
  for (const auto& triangle : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const int a = place[static_cast<std::size_t>(triangle[i])],
                b = place[static_cast<std::size_t>(triangle[(i + 1) % 3])];
      ++balance[{a, b}];
      --balance[{b, a}];
    }
  return std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; });
}

TEST(ToolMesh, IsClosedOutwardAndLight) {
  for (const simulation::ToolKind kind : kEveryTool) {
    const app::ToolMesh tool = app::MakeToolMesh(kind);
    EXPECT_LE(tool.body.triangles.size() + tool.moving.triangles.size(), 6000u);
    for (const SurfaceMesh* mesh : {&tool.body, &tool.moving}) {
      if (mesh->triangles.empty()) continue;
      EXPECT_TRUE(IsClosed(*mesh)) << static_cast<int>(kind);
      double volume = 0;
      for (const auto& [a, b, c] : mesh->triangles) {
        const auto& v = mesh->vertices;
        volume += glm::dot(v[a], glm::cross(v[b], v[c])) / 6.0;
      }
      EXPECT_GT(volume, 0.0) << static_cast<int>(kind);
    }
    EXPECT_EQ(tool.moving.triangles.empty(), kind == simulation::ToolKind::kProbe);
  }
}

// Largest width across the rod, farther than 20 mm behind the tip: the diameters of real shafts.
TEST(ToolMesh, HasTheDiameterOfTheRealShaft) {
  const double diameters[] = {3.0e-3, 3.4e-3, 4.5e-3, 3.4e-3};
  for (int i = 0; i < 4; ++i) {
    double widest = 0;
    for (const glm::dvec3& v : app::MakeToolMesh(kEveryTool[i]).body.vertices)
      if (v.z < -20e-3) widest = std::max(widest, std::hypot(v.x, v.y));
    EXPECT_NEAR(2.0 * widest, diameters[i], 1e-6) << i;
  }
}

TEST(ToolMesh, TheBladeOfTheShaverTurnsInsideItsTubeBehindAWindow) {
  using namespace simulation;
  const app::ToolMesh mesh = app::MakeToolMesh(ToolKind::kShaver);
  const double tube = ShapeOf(ToolKind::kShaver).capsules[0].radius;
  for (const glm::dvec3& x : mesh.body.vertices) EXPECT_LE(std::hypot(x.x, x.y), tube + 1e-9);
  for (const double turn : {0.0, 1.0, 4.0}) {
    const Pose part = app::MovingPart(mesh, 0.5, turn);
    for (const glm::dvec3& x : mesh.moving.vertices)
      EXPECT_LT(std::hypot((part * x).x, (part * x).y), tube - 0.2e-3);
  }
  // The window is open where tissue is removed: no triangle of the tube lies over its middle.
  const Capsule bite = ShapeOf(ToolKind::kShaver).bite;
  const glm::dvec3 middle{0, tube, 0.5 * (bite.a.z + bite.b.z)};
  for (const auto& [a, b, c] : mesh.body.triangles) {
    const auto& v = mesh.body.vertices;
    EXPECT_GT(glm::distance((v[a] + v[b] + v[c]) / 3.0, middle), 1e-3);
  }
}

TEST(ProbeMesh, IsClosedAndTouchesItsOriginWithTheSideOfTheHook) {
  const app::ProbeShape shape;
  const SurfaceMesh mesh = app::MakeProbeMesh(shape);
  double top = -1, reach = 0, back = 0, widest = 0;
  for (const glm::dvec3& v : mesh.vertices) {
    top = std::max(top, v.z);
    back = std::min(back, v.z);
    reach = std::max(reach, v.y);
    widest = std::max(widest, std::abs(v.x));
  }
  EXPECT_NEAR(top, 0.0, 1e-12);
  EXPECT_NEAR(back, -shape.shaft_length, 0.3e-3);
  EXPECT_NEAR(reach, shape.hook_length, 20e-6);
  EXPECT_NEAR(widest, 1.5e-3, 1e-9);
  // Normals face outwards, away from the shaft's axis.
  std::vector<glm::dvec3> normals(mesh.vertices.size());
  ComputeVertexNormals(mesh.vertices, mesh.triangles, normals);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (mesh.vertices[i].z < -0.02 && mesh.vertices[i].z > -0.119) {
      EXPECT_GT(glm::dot(normals[i],
                         glm::normalize(glm::dvec3(mesh.vertices[i].x, mesh.vertices[i].y, 0))),
                0.95);
    }
}

}  // namespace
}  // namespace arthro::test
