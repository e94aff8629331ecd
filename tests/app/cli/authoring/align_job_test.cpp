// The align job: landmarks of the small scene's octahedron, given in each way.
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "tests/app/cli/job_inputs.h"
#include "tests/support/run_program.h"
#include "tests/support/shapes.h"

namespace arthro::test {
namespace {

const Pose kTruth{glm::dvec3(0.004, -0.003, 0.028),
                  glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, -1))), 1.0};

class AlignJob : public JobInputs {
 protected:
  // Corners of the octahedron, with their true places; `shift` moves the second one, m.
  void WritePairs(int count, double shift = 0) {
    nlohmann::json json{{"schema", "arthroscene.pairs/1"}};
    const SurfaceMesh model = Octahedron(0.006);
    for (int i = 0; i < count; ++i) {
      const glm::dvec3& x = model.vertices[static_cast<std::size_t>(i)];
      glm::dvec3 y = kTruth * x;
      if (i == 1) y.z += shift;
      json["pairs"].push_back({{"name", fmt::format("corner {}", i)},
                               {"model", {x.x, x.y, x.z}},
                               {"place", {{"position", {y.x, y.y, y.z}}, {"sigma", 2e-4}}}});
    }
    WriteAtomically(At("pairs.json"), json.dump());
  }
  ProgramResult Align(const std::string& more = "") const {
    return RunProgram(
        Whole("align @S --tissue octahedron --pairs @pairs.json -o @A --report @r.json " + more));
  }
};

TEST_F(AlignJob, WritesTheSceneWithTheTissueInItsPlace) {
  WritePairs(6);
  const std::string before = ReadWholeFile(At("S/scene.json"));
  const ProgramResult run = Align();
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_NE(run.out.find("octahedron aligned to 0.00 mm rms"), std::string::npos) << run.out;
  EXPECT_EQ(ReadWholeFile(At("S/scene.json")), before);
  const LoadedScene aligned = LoadScene(At("A"));
  EXPECT_LT(glm::distance(aligned.scene.tissues.at(0).pose.position, kTruth.position), 1e-8);
  const auto report = nlohmann::json::parse(ReadWholeFile(At("r.json")));
  EXPECT_EQ(report.at("schema"), "arthroscene.align/1");
  EXPECT_EQ(report.at("landmarks").at("pairs").size(), 6u);
  EXPECT_GT(report.at("landmarks").at("position_sigma"), 0.0);
}

TEST_F(AlignJob, NamesAWrongPairAndGoesOn) {
  WritePairs(6, 0.007);
  const ProgramResult run = Align();
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("warning: Pair 2 (corner 1) is 7.0 mm away"), std::string::npos)
      << run.err;
  const LoadedScene aligned = LoadScene(At("A"));
  EXPECT_LT(glm::distance(aligned.scene.tissues.at(0).pose.position, kTruth.position), 1e-6);
}

TEST_F(AlignJob, TakesTheRangeOfAPixelFromTheRelief) {
  const LoadedScene scene = LoadScene(At("S"));
  nlohmann::json json{{"schema", "arthroscene.pairs/1"}};
  // A model whose points lie on the relief when it is in its true pose.
  for (const glm::ivec2 pixel :
       {glm::ivec2(150, 120), glm::ivec2(260, 110), glm::ivec2(240, 200), glm::ivec2(170, 190)}) {
    const glm::dvec3 place = (0.05 - scene.depth->at(pixel.x, pixel.y)) *
                             DirectionFromPixel(scene.scene.backdrop.projection, pixel);
    const glm::dvec3 x = glm::conjugate(kTruth.quaternion) * (place - kTruth.position);
    json["pairs"].push_back(
        {{"model", {x.x, x.y, x.z}}, {"panorama", {{"pixel", {pixel.x, pixel.y}}}}});
  }
  WriteAtomically(At("pairs.json"), json.dump());
  const ProgramResult run = Align();
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const LoadedScene aligned = LoadScene(At("A"));
  EXPECT_LT(glm::distance(aligned.scene.tissues.at(0).pose.position, kTruth.position), 1e-6);
}

TEST_F(AlignJob, RefusesInOneSentenceAndWritesNoScene) {
  WritePairs(2);
  EXPECT_EQ(Align().exit_code, 1);
  EXPECT_NE(Align().err.find("Three pairs or more are needed"), std::string::npos);
  WritePairs(6);
  const ProgramResult other =
      RunProgram(Whole("align @S --tissue meniscus --pairs @pairs.json -o @A"));
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.err.find("there is no tissue \"meniscus\"; this scene has \"octahedron\""),
            std::string::npos)
      << other.err;
  WriteAtomically(At("pairs.json"), "{");
  EXPECT_EQ(Align().exit_code, 1);
  EXPECT_FALSE(std::filesystem::exists(At("A")));
}

TEST_F(AlignJob, ALandmarkOnAHoleIsRefusedByItsNumber) {
  LoadedScene scene = LoadScene(At("S"));
  DepthMap depth = *scene.depth;
  for (int v = 100; v < 140; ++v)
    for (int u = 130; u < 170; ++u) depth.at(u, v) = std::nanf("");
  WriteDepthMap(std::filesystem::path(At("S")) / scene.scene.backdrop.depth, depth);
  nlohmann::json json{{"schema", "arthroscene.pairs/1"}};
  for (const glm::ivec2 pixel : {glm::ivec2(260, 110), glm::ivec2(150, 120)})
    json["pairs"].push_back({{"model", {0, 0, 0}}, {"panorama", {{"pixel", {pixel.x, pixel.y}}}}});
  WriteAtomically(At("pairs.json"), json.dump());
  const ProgramResult run = Align();
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("pairs[1]: nothing was imaged there"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("choose another place"), std::string::npos) << run.err;
}

TEST_F(AlignJob, LaysTheSurfaceOntoTheRelief) {
  WriteSurface(At("S/octahedron.ply"), Sphere({0, 0, 0}, 0.006, 4));
  Scene scene = ReadScene(At("S"));
  scene.tissues.at(0).pose.position.z = 0.037;
  WriteScene(At("S/scene.json"), scene);
  const ProgramResult run = RunProgram(
      Whole("align @S --tissue octahedron --surface --reach-mm 25 -o @A --report @r.json"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("laid onto the relief in"), std::string::npos) << run.out;
  const auto surface = nlohmann::json::parse(ReadWholeFile(At("r.json"))).at("surface");
  EXPECT_LT(surface.at("after").at("median"), surface.at("before").at("median"));
  const ProgramResult none = RunProgram(Whole("align @S --tissue octahedron -o @B"));
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.err.find("give --pairs, --surface or both"), std::string::npos) << none.err;
}

TEST_F(AlignJob, GivesTheSameBytesTwice) {
  WritePairs(6, 0.0001);
  ASSERT_EQ(Align().exit_code, 0);
  const std::string report = ReadWholeFile(At("r.json"));
  ASSERT_EQ(RunProgram(Whole("align @S --tissue octahedron --pairs @pairs.json -o @B --report "
                             "@r.json"))
                .exit_code,
            0);
  EXPECT_EQ(ReadWholeFile(At("B/scene.json")), ReadWholeFile(At("A/scene.json")));
  EXPECT_EQ(ReadWholeFile(At("r.json")), report);
}

}  // namespace
}  // namespace arthro::test
