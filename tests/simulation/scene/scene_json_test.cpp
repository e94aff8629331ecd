#include "simulation/scene/json/scene_json.h"

#include <functional>
#include <limits>

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "tests/support/example_scene.h"

namespace arthro {
namespace {

using nlohmann::json;

std::vector<JsonFault> FaultsOf(const json& scene) {
  std::vector<JsonFault> faults;
  SceneFromJson(scene, faults);
  return faults;
}

TEST(SceneJson, ErrorAndOriginsOfADepthMapNeedTheDepthMap) {
  json scene = test::FullSceneJson();
  scene["backdrop"].erase("depth");
  const std::vector<JsonFault> faults = FaultsOf(scene);
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].key, "backdrop.depth_sigma");
  EXPECT_EQ(faults[1].key, "backdrop.depth_origin");
  EXPECT_NE(faults[0].sentence.find("without backdrop.depth"), std::string::npos);
}

TEST(SceneJson, ReadsEveryField) {
  std::vector<JsonFault> faults;
  const Scene scene = SceneFromJson(test::FullSceneJson(), faults);
  for (const JsonFault& fault : faults) ADD_FAILURE() << fault.sentence;
  EXPECT_EQ(scene.title, "Medial meniscus, right knee");
  EXPECT_EQ(scene.author, "Dr. Ó Súilleabháin");
  EXPECT_EQ(scene.backdrop.panorama, "pictures/panorama.png");
  EXPECT_EQ(scene.backdrop.depth, "depth.tiff");
  EXPECT_EQ(scene.backdrop.depth_sigma, "sigma.tiff");
  EXPECT_EQ(scene.backdrop.depth_origin, "origin.png");
  EXPECT_EQ(scene.backdrop.radius, 0.045);
  EXPECT_EQ(scene.backdrop.projection.type, ProjectionType::kGnomonic);
  EXPECT_EQ(scene.backdrop.projection.centre_px, glm::dvec2(31.5, 15.5));
  EXPECT_EQ(scene.backdrop.projection.focal_px, 40);
  EXPECT_EQ(scene.backdrop.rights.source, "phantom");
  EXPECT_EQ(scene.backdrop.rights.licence, "CC0-1.0");
  EXPECT_EQ(scene.backdrop.rights.consent, "none needed: synthetic");
  EXPECT_EQ(scene.scope.view_angle, RadiansFromDegrees(70));
  EXPECT_EQ(scene.scope.field_of_view, RadiansFromDegrees(105));
  EXPECT_EQ(scene.scope.lens, "lens.json");
  EXPECT_EQ(scene.portals.incision_spacing, -0.028);
  EXPECT_EQ(scene.rig.scope.pivot, glm::dvec3(0.01, 0.02, 0.15));
  EXPECT_EQ(scene.rig.scope.portal_from_device, glm::dquat(0, 1, 0, 0));
  EXPECT_EQ(scene.rig.scope.rod_length, 0.25)
      << "the scope's rod is told once, at scope.rod_length";
  EXPECT_EQ(scene.rig.instrument.rod_length, 0.18);
  EXPECT_EQ(scene.rig.instrument.pivot, glm::dvec3(0, 0, 0.1));
  ASSERT_EQ(scene.tissues.size(), 2u);
  const Tissue& meniscus = scene.tissues[0];
  EXPECT_EQ(meniscus.name, "medial meniscus");
  EXPECT_EQ(meniscus.surface, "meniscus.ply");
  EXPECT_EQ(meniscus.mesh, "meniscus.vtu");
  EXPECT_EQ(meniscus.pose.position, glm::dvec3(0.001, 0.002, 0.03));
  EXPECT_EQ(meniscus.pose.quaternion, glm::dquat(0, 0, 1, 0));
  EXPECT_EQ(meniscus.pose.scale, 1.25);
  EXPECT_EQ(meniscus.colour, glm::dvec3(0.9, 0.8, 0.7));
  EXPECT_EQ(meniscus.rights.consent, "given in writing");
  EXPECT_EQ(meniscus.elasticity.young_modulus, 4e5);
  EXPECT_EQ(meniscus.elasticity.poisson_ratio, 0.4);
  EXPECT_EQ(meniscus.elasticity.density, 1050);
  EXPECT_EQ(meniscus.elasticity.fibre_stiffness, 1e7);
  EXPECT_EQ(meniscus.elasticity.fibre_axis, "circumferential_z");
  EXPECT_EQ(meniscus.elasticity.layer_thickness, 0.002);
  EXPECT_EQ(meniscus.fixed, (std::vector<Ball>{{{0.01, 0, 0.002}, 0.003}, {{0, -0.01, 0}, 0.002}}));
  EXPECT_EQ(
      meniscus.cuts,
      (std::vector<Cut>{TearCut{{{0, 0, 0.002}, {0.003, 0.001, 0.002}, {0.006, 0, 0.002}},
                                {0, 0.1, -1},
                                0.003,
                                0.0006,
                                0.0015},
                        CapsuleCut{{0.01, 0, 0}, {0.01, 0.002, 0}, 0.0015},
                        BoxCut{{glm::dquat(0, 0, 0, 1), {0, 0.01, 0}}, {0.002, 0.001, 0.001}}}));
  EXPECT_EQ(meniscus.regions, (std::vector<Region>{{"anterior horn", {{0, 0.01, 0}, 0.005}},
                                                   {"posterior horn", {{0, -0.01, 0}, 0.006}}}));
  EXPECT_FALSE(meniscus.is_cuttable);
  EXPECT_EQ(scene.tissues[1].pose.scale, 1.0);
  EXPECT_EQ(scene.tissues[1].elasticity, Elasticity{});
  EXPECT_EQ(meniscus.probed, (std::vector<Ball>{{{0, 0.01, 0.001}, 0.0015}}));
  EXPECT_TRUE(scene.tissues[1].fixed.empty());
  EXPECT_TRUE(scene.tissues[1].probed.empty());
  EXPECT_TRUE(scene.tissues[1].is_cuttable);
  EXPECT_FALSE(meniscus.is_implicit);
  EXPECT_TRUE(scene.tissues[1].is_implicit);
  ASSERT_EQ(scene.instruments.size(), 2u);
  EXPECT_EQ(scene.instruments[1].kind, "punch");
  ASSERT_EQ(scene.exercises.size(), 2u);
  EXPECT_EQ(scene.exercises[0].brief, "Find the posterior horn.");
  EXPECT_EQ(scene.exercises[0].version, 1);
  const Exercise& exercise = scene.exercises[1];
  ASSERT_EQ(exercise.steps.size(), 12u);
  EXPECT_EQ(exercise.targets[0].bearing,
            glm::dvec2(RadiansFromDegrees(-0.5), RadiansFromDegrees(-21.3)));
  EXPECT_EQ(KindOf(exercise.targets[3]), TargetKind::kRegions);
  EXPECT_EQ(exercise.setup.view_angles,
            (std::vector<double>{RadiansFromDegrees(30), RadiansFromDegrees(70)}));
  EXPECT_EQ(std::get<SeeStep>(exercise.steps[0]).incidence, RadiansFromDegrees(50));
  EXPECT_EQ(BaseOf(exercise.steps[0]).next, (StepNext{"s2", "end"}));
  EXPECT_EQ(scene.extensions.at("x-course"), R"({"week":3})");
}

TEST(SceneJson, ShortestSceneTakesTheDefaults) {
  const json shortest = {
      {"schema", "arthroscene.scene/2"},
      {"backdrop",
       {{"panorama", "p.png"},
        {"projection",
         {{"type", "equirectangular"}, {"centre_px", {10, 20}}, {"px_per_deg", 12.5}}}}}};
  std::vector<JsonFault> faults;
  const Scene scene = SceneFromJson(shortest, faults);
  EXPECT_TRUE(faults.empty());
  EXPECT_EQ(scene.backdrop.projection.px_per_deg, 12.5);
  EXPECT_EQ(scene.backdrop.radius, 0.05);
  EXPECT_EQ(scene.scope.view_angle, RadiansFromDegrees(30));
  EXPECT_EQ(scene.scope.field_of_view, RadiansFromDegrees(90));
  EXPECT_EQ(scene.portals.incision_spacing, 0.03);
  EXPECT_EQ(scene.rig.scope.rod_length, 0.2);
  EXPECT_EQ(scene.rig.instrument.rod_length, 0.2);
  EXPECT_TRUE(scene.tissues.empty());
}

TEST(SceneJson, WritingAndReadingGivesTheSameScene) {
  std::vector<JsonFault> faults;
  Scene scene = SceneFromJson(test::FullSceneJson(), faults);
  scene.tissues[0].pose.quaternion = glm::normalize(glm::dquat(0.3, -0.2, 0.77, 0.1));
  scene.rig.scope.portal_from_device = glm::normalize(glm::dquat(0.1, 0.9, -0.2, 0.3));
  const std::string text = PrettyJson(JsonFromScene(scene));
  const Scene back = SceneFromJson(json::parse(text), faults);
  EXPECT_TRUE(faults.empty());
  // The text holds every field exactly, so equal texts are equal scenes.
  EXPECT_EQ(PrettyJson(JsonFromScene(back)), text);
  EXPECT_EQ(back.tissues[0].pose.quaternion, scene.tissues[0].pose.quaternion);
  EXPECT_EQ(back.tissues[0].cuts, scene.tissues[0].cuts);
  EXPECT_EQ(back.tissues[0].regions, scene.tissues[0].regions);
  EXPECT_EQ(back.scope.view_angle, scene.scope.view_angle);
  EXPECT_NE(text.find("\"view_angle_deg\": 70.0"), std::string::npos) << text;
  EXPECT_NE(text.find("\"centre_px\": [31.5, 15.5]"), std::string::npos) << text;
}

// Every key of the file that is read is also written, so that nothing is lost by saving.
TEST(SceneJson, JointHoldsSalineUnlessTheFileSaysGas) {
  std::vector<JsonFault> faults;
  json file = test::FullSceneJson();
  file["backdrop"].erase("medium");
  EXPECT_EQ(SceneFromJson(file, faults).backdrop.medium, Medium::kSaline);
  EXPECT_FALSE(JsonFromScene(SceneFromJson(file, faults)).at("backdrop").contains("medium"));
  file["backdrop"]["medium"] = "gas";
  EXPECT_EQ(SceneFromJson(file, faults).backdrop.medium, Medium::kGas);
  EXPECT_EQ(JsonFromScene(SceneFromJson(file, faults)).at("backdrop").at("medium"), "gas");
  EXPECT_TRUE(faults.empty());
  file["backdrop"]["medium"] = "air";
  SceneFromJson(file, faults);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].sentence.find("saline, gas"), std::string::npos) << faults[0].sentence;
}

TEST(SceneJson, WritesEveryKeyThatItReads) {
  std::vector<JsonFault> faults;
  const json full = test::FullSceneJson();
  const json read = full.flatten();
  const json written = json(JsonFromScene(SceneFromJson(full, faults))).flatten();
  ASSERT_GT(read.size(), 50u);
  for (const auto& [pointer, value] : read.items())
    EXPECT_TRUE(written.contains(pointer)) << pointer;
}

TEST(SceneJson, NamesTheKeyAndTheRemedyOfEveryFault) {
  for (const test::SceneFault& fault : test::SceneFaults()) {
    json scene = test::FullSceneJson();
    scene[json::json_pointer(fault.pointer)] = fault.value;
    const auto found = FaultsOf(scene);
    ASSERT_EQ(found.size(), 1u) << fault.pointer << " " << fault.value
                                << (found.empty() ? "" : found.back().sentence);
    EXPECT_EQ(found[0].key, fault.key);
    EXPECT_TRUE(found[0].sentence.starts_with(fault.key)) << found[0].sentence;
    EXPECT_NE(found[0].sentence.find(fault.says), std::string::npos) << found[0].sentence;
  }
}

TEST(SceneJson, TellsAllFaultsNotOnlyTheFirst) {
  json scene = test::FullSceneJson();
  scene["backdrop"]["radius"] = -1;
  scene["backdrop"].erase("panorama");
  scene["scope"]["view_angle_deg"] = "thirty";
  scene["tissues"][1].erase("surface");
  EXPECT_EQ(FaultsOf(scene).size(), 4u);
}

TEST(SceneJson, ATissueIsAFunctionOrHasAMesh) {
  json scene = test::FullSceneJson();
  scene["tissues"][0]["implicit"] = true;
  const std::vector<JsonFault> faults = FaultsOf(scene);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].sentence.find("tissues[0].implicit"), std::string::npos)
      << faults[0].sentence;
  EXPECT_NE(faults[0].sentence.find("mesh"), std::string::npos) << faults[0].sentence;
}

TEST(SceneJson, LongAndForeignLettersInAFaultStayReadable) {
  json scene = test::FullSceneJson();
  scene["backdrop"]["radius"] = std::string(100000, 'a');
  std::string long_key;
  for (int i = 0; i < 100; ++i) long_key += "ö";
  scene[long_key] = 1;
  for (const JsonFault& fault : FaultsOf(scene)) {
    EXPECT_LT(fault.sentence.size(), 300u);
    EXPECT_NO_THROW(json(fault.sentence).dump()) << "cut in the middle of a letter";
  }
}

}  // namespace
}  // namespace arthro
