#include "simulation/tissue/cases/case_io.h"

#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/core/error.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/temp_folder.h"
#include "tests/support/tissue/tissue_meshes.h"

namespace arthro::simulation {
namespace {

using namespace nlohmann::literals;

nlohmann::json GoodCase() {
  return nlohmann::json::parse(
      R"({"mesh": "beam.vtu", "order": 1, "mode": "static", "tolerance": 1e-8,
    "material": {"model": "stable_neo_hookean", "young_modulus": 1e6, "poisson_ratio": 0.3, "density": 1100},
    "fixed": [{"set": "clamp", "axes": "xz"}, {"set": "tip", "axes": "y"}], "loads": [{"set": "end", "total_force": [0.5, 0, 0]}]})");
}

TissueCase Read(const nlohmann::json& json, TetMesh mesh = test::BeamMesh(1, {2, 1, 1})) {
  const test::TempFolder folder;
  mesh.sets["nobody"].assign(mesh.rest_positions.size(), 0);
  // Edge of the clamped side: fixing its three axes leaves a hinge.
  for (const glm::dvec3& x : mesh.rest_positions)
    mesh.sets["hinge"].push_back(x.x == 0 && x.y == 0 ? 1 : 0);
  WriteTetMesh(folder / "beam.vtu", mesh);
  std::ofstream(folder / "case.json") << json.dump();
  return ReadCase(folder / "case.json");
}

TEST(CaseIo, ReadsACase) {
  const TissueCase c = Read(GoodCase());
  EXPECT_EQ(c.material.young_modulus, 1e6);
  EXPECT_EQ(c.fixed.at(0).axes, 1 | 4);
  EXPECT_EQ(c.loads.at(0).total_force, glm::dvec3(0.5, 0, 0));
  EXPECT_FALSE(c.is_dynamic);
}

TEST(CaseIo, MidEdgeNodeBelongsToASetOfBothEnds) {
  auto json = GoodCase();
  json["order"] = 2;
  TetMesh mesh = test::BeamMesh(2, {2, 2, 2});
  const std::vector<std::uint8_t> whole = mesh.sets["clamp"];
  for (std::size_t e = 0; e < mesh.elements.size(); e += 10)
    for (int a = 4; a < 10; ++a) mesh.sets["clamp"][mesh.elements[e + a]] = 0;
  ASSERT_NE(mesh.sets["clamp"], whole);
  EXPECT_EQ(Read(json, mesh).mesh.sets["clamp"], whole);
}

struct BadCase {
  const char* pointer;
  nlohmann::json value;  // null: the key is removed
  const char* says;
};

TEST(CaseIo, ConflictingDisplacementsAreRefused) {
  auto json = GoodCase();
  json["fixed"] = R"([{"set": "clamp"}])"_json;
  json["displaced"] = R"([{"set": "end", "displacement": [0.001, 0, 0]},
                          {"set": "tip", "displacement": [0.001, 0, 0]}])"_json;
  EXPECT_EQ(Read(json).displaced.size(), 2u) << "both prescribe the same motion";
  json["displaced"][1]["displacement"][0] = 0.002;
  try {
    Read(json);
    FAIL() << "a conflict was accepted";
  } catch (const Error& error) {
    EXPECT_NE(error.sentence().find("displaced[0] \"end\" leads elsewhere"), std::string::npos)
        << error.sentence();
  }
}

TEST(CaseIo, NamesEachFault) {
  const std::vector<BadCase> bad = {
      {"/mesh", nullptr, "mesh is missing"},
      {"/mesh", "other.vtu", "other.vtu"},
      {"/order", 2, "order is 2"},
      {"/order", "1", "order is"},
      {"/order", 1.5, "order is 1.5; it must be 1 or 2"},
      {"/mode", "quick", "static or dynamic"},
      {"/mode", "dynamic", "dt is missing"},
      {"/mode", 3, "mode is 3"},
      {"/material", nullptr, "material is missing"},
      {"/material", 3, "material must be"},
      {"/material/poisson_ratio", 0.5, "poisson_ratio"},
      {"/material/young_modulus", -1, "young_modulus"},
      {"/material/density", 0, "density"},
      {"/material/model", "rubber", "stable_neo_hookean"},
      {"/material/fibre_stiffness", 1e6, "fibre_axis"},
      {"/material/colour", 1, "colour"},
      {"/fixed/0/set", "clmap", "it has clamp, end, hinge, nobody, tip"},
      {"/fixed/0/set", "nobody", "without a node"},
      {"/fixed/0/axes", "xq", "letters x, y and z"},
      {"/fixed/0/axes", "", "letters x, y and z"},
      {"/fixed", nlohmann::json::array(), "nothing holds the body"},
      {"/fixed", R"([{"set": "clamp", "axes": "xz"}])"_json, "nowhere along y"},
      {"/fixed", R"([{"set": "clamp", "axes": "x"}])"_json, "nowhere along y and z"},
      {"/fixed", R"([{"set": "hinge"}])"_json, "lets the body turn"},
      {"/displaced", R"([{"set": "clamp", "displacement": [0.001, 0, 0]}])"_json,
       "displaced[0].set \"clamp\" has 4 nodes that fixed[0] \"clamp\" holds"},
      {"/displaced", R"([{"set": "end", "displacement": [0.001, 0, 0]}])"_json,
       "has 4 nodes that fixed[1] \"tip\" holds"},
      {"/loads/0/set", "nobody", "without a node"},
      {"/loads/0/total_force", {1, 2}, "3 numbers"},
      {"/loads/0/total_force", {1, 2, "x"}, "3 numbers"},
      {"/loads/0/total_forse", {1, 2, 3}, "total_forse"},
      {"/tolerance", -1, "tolerance"},
      {"/tolerence", 1e-8, "did you mean \"tolerance\""},
  };
  for (const BadCase& one : bad) {
    auto json = GoodCase();
    if (one.value.is_null())
      json.erase(std::string(one.pointer).substr(1));
    else
      json[nlohmann::json::json_pointer(one.pointer)] = one.value;
    try {
      Read(json);
      ADD_FAILURE() << one.pointer << " was accepted";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(one.says), std::string::npos)
          << one.pointer << ": " << error.what();
    }
  }
}

}  // namespace
}  // namespace arthro::simulation
