#include "authoring/adjustment/mirror_scene.h"

#include <map>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "authoring/project/document_io.h"
#include "simulation/core/atomic_file.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/scene/solids/solid_function.h"
#include "simulation/scene/solids/solid_io.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

// A solid whose only part lies to one side and is turned.
void AddSolid(const test::TempFolder& folder, Document& document) {
  EllipsoidPart part;
  part.radii = {0.001, 0.002, 0.003};
  part.place.solid_from_part = {glm::normalize(glm::dquat(0.9, 0.1, 0.3, -0.2)), {0.004, 0, 0.001}};
  const Solid solid{{part}};
  WriteSolid(folder / "egg.solid", solid);
  Tissue tissue;
  tissue.name = "egg";
  tissue.surface = "tissues/egg.solid";
  tissue.is_implicit = true;
  tissue.pose.position = {0.002, 0, 0.03};
  document.scene.tissues.push_back(tissue);
  const auto surface = Share(SurfaceOfSolid(solid));
  document.surfaces.push_back(surface);
  document.files["tissues/egg.solid"] = {folder / "egg.solid", surface, {}};
}

// A scene with everything that has a side.
Document SidedScene(const test::TempFolder& folder) {
  Document document = OpenDocument(test::WriteSmallScene(folder / "scene"));
  Scene& scene = document.scene;
  scene.side = BodySide::kRight;
  scene.portals.incision_spacing = 0.028;
  scene.backdrop.projection.centre_px = {187.25, 140};
  scene.backdrop.projection.roll = 0.3;
  document.depth_sigma = Share(DepthMap(400, 300, 1e-4f));
  scene.backdrop.depth_sigma = "sigma.tiff";
  Tissue& tissue = scene.tissues[0];
  tissue.pose.position = {0.004, -0.002, 0.03};
  tissue.pose.quaternion = glm::normalize(glm::dquat(0.9, 0.1, 0.3, -0.2));
  tissue.fixed = {{{0.003, 0.001, 0}, 0.002}};
  tissue.cuts = {TearCut{{{0.001, 0, 0.002}, {0.004, 0.001, 0.002}}, {0.2, 0.1, -1}}};
  TetMesh mesh;
  mesh.rest_positions = {{0, 0, 0}, {0.004, 0, 0}, {0, 0.004, 0}, {0, 0, 0.004}};
  mesh.elements = {0, 1, 2, 3};
  WriteTetMesh(folder / "made.vtu", mesh);
  tissue.mesh = "octahedron.vtu";
  document.files["octahedron.vtu"].file = folder / "made.vtu";
  AddSolid(folder, document);
  document.depth_strokes =
      Share(DepthStrokes{{.radius = 0.03, .points = {{0.25, 0.125}, {0.75, 0.5}}}});
  document.unmended.depth = document.depth;  // an imported map
  return document;
}

std::map<std::string, std::string> BytesOf(const fs::path& folder) {
  std::map<std::string, std::string> bytes;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      bytes[fs::relative(entry.path(), folder).generic_string()] = ReadWholeFile(entry.path());
  return bytes;
}

NewFile In(const fs::path& folder) {
  return [folder, n = 0](const fs::path& name) mutable {
    return folder / (std::to_string(++n) + name.string());
  };
}

TEST(MirrorScene, TwiceIsTheSameSceneByteByByte) {
  const test::TempFolder folder;
  Document document = SidedScene(folder);
  SaveDocument(document, folder / "first");
  Document once = OpenDocument(folder / "first");
  MirrorScene(once, In(folder.path()));
  SaveDocument(once, folder / "once");
  Document twice = OpenDocument(folder / "once");
  MirrorScene(twice, In(folder.path()));
  SaveDocument(twice, folder / "twice");
  const auto first = BytesOf(folder / "first"), second = BytesOf(folder / "once"),
             third = BytesOf(folder / "twice");
  EXPECT_NE(first.at("scene.json"), second.at("scene.json"));
  ASSERT_EQ(first.size(), third.size());
  for (const auto& [name, bytes] : first) {
    ASSERT_TRUE(third.contains(name)) << name;
    EXPECT_EQ(third.at(name), bytes) << name;
  }
}

TEST(MirrorScene, EveryPointLiesWhereTheMirrorShowsIt) {
  const test::TempFolder folder;
  const Document before = SidedScene(folder);
  Document after = before;
  MirrorScene(after, In(folder.path()));
  const auto mirrored = [](glm::dvec3 x) { return glm::dvec3(-x.x, x.y, x.z); };
  const Tissue &old_tissue = before.scene.tissues[0], &tissue = after.scene.tissues[0];
  for (std::size_t i = 0; i < before.surfaces[0]->vertices.size(); ++i)
    EXPECT_LT(glm::distance(tissue.pose * after.surfaces[0]->vertices[i],
                            mirrored(old_tissue.pose * before.surfaces[0]->vertices[i])),
              1e-15);
  EXPECT_LT(glm::distance(tissue.pose * tissue.fixed[0].centre,
                          mirrored(old_tissue.pose * old_tissue.fixed[0].centre)),
            1e-15);
  for (const auto& [x, y] : {std::pair{0, 0}, {399, 299}, {31, 205}}) {
    EXPECT_EQ(after.depth->at(399 - x, y), before.depth->at(x, y));
    EXPECT_LT(glm::distance(DirectionFromPixel(after.scene.backdrop.projection, {399 - x, y}),
                            mirrored(DirectionFromPixel(before.scene.backdrop.projection, {x, y}))),
              1e-12);
  }
  const Solid egg = ReadSolid(FileOf(before, before.scene.tissues[1].surface)),
              other = ReadSolid(FileOf(after, after.scene.tissues[1].surface));
  const SolidFunction function(egg), mirrored_function(other);
  for (const glm::dvec3& x : {glm::dvec3(0.005, 0.001, 0), {-0.002, 0.003, 0.004}, {0.004, 0, 0}})
    EXPECT_NEAR(mirrored_function.Value(mirrored(x)), function.Value(x), 1e-12);
  EXPECT_EQ(after.depth_strokes->at(0).points.at(0), glm::dvec2(0.75, 0.125));
  EXPECT_EQ(after.scene.portals.incision_spacing, -0.028);
  EXPECT_EQ(after.scene.side, BodySide::kLeft);
}

// det(x1 - x0, x2 - x0, x3 - x0) of an element must stay positive.
TEST(MirrorScene, ElementsAreNotTurnedInsideOut) {
  for (const int order : {1, 2}) {
    TetMesh mesh;
    mesh.order = order;
    mesh.rest_positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
    mesh.elements = {0, 1, 2, 3};
    if (order == 2)
      for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}) {
        mesh.elements.push_back(static_cast<int>(mesh.rest_positions.size()));
        mesh.rest_positions.push_back(0.5 * (mesh.rest_positions[a] + mesh.rest_positions[b]));
      }
    const TetMesh mirrored = Mirrored(mesh);
    const auto x = [&](int node) { return mirrored.rest_positions[mirrored.elements[node]]; };
    EXPECT_GT(glm::dot(glm::cross(x(1) - x(0), x(2) - x(0)), x(3) - x(0)), 0);
    if (order == 2) {
      int node = 4;
      for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}})
        EXPECT_EQ(x(node++), 0.5 * (x(a) + x(b)));
    }
    EXPECT_EQ(Mirrored(mirrored).elements, mesh.elements);
  }
}

}  // namespace
}  // namespace arthro::authoring
