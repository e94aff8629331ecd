// Models of the library, made as a user makes them.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/app/cli/job_inputs.h"
#include "tests/support/run_program.h"

namespace arthro::test {
namespace {

using ModelJob = JobInputs;

#define EXPECT_SAYS(sentence, part) \
  EXPECT_NE((sentence).find(part), std::string::npos) << "it said: " << (sentence)

TEST_F(ModelJob, WritesASurfaceAndItsSizesWithSources) {
  const ProgramResult run = RunProgram(
      Whole("model medial-meniscus --side left --body-width-mm 8 -o @m.vtp --report @r.json"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_SAYS(run.out, "width of the body: 8.");
  EXPECT_GT(ReadSurface(At("m.vtp"), 1.0).triangles.size(), 1000u);
  EXPECT_SAYS(ReadWholeFile(At("m.vtp")), "zone");
  const auto report = nlohmann::json::parse(ReadWholeFile(At("r.json")));
  EXPECT_EQ(report["schema"], "arthroscene.model/1");
  EXPECT_EQ(report["side"], "left");
  EXPECT_TRUE(report["is_closed"]);
  EXPECT_EQ(report["sizes"].size(), 11u);
  for (const auto& size : report["sizes"]) EXPECT_TRUE(size["is_in_range"]) << size;
  EXPECT_EQ(report["area_of_zones"].size(), 3u);
}

TEST_F(ModelJob, ATearIsCutIntoTheSurface) {
  const ProgramResult run =
      RunProgram(Whole("model lateral-meniscus --tear radial -o @m.ply --report @r.json"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto report = nlohmann::json::parse(ReadWholeFile(At("r.json")));
  EXPECT_EQ(report["cuts"], 1);
  EXPECT_GT(report["volume_of_cuts"].get<double>(), 1e-9);
}

TEST_F(ModelJob, AddsATissueWithTetrahedraHoldsAndCutsToAScene) {
  const ProgramResult run = RunProgram(
      Whole("model medial-meniscus --tear bucket-handle --scene @S --save-scene @T.arthro"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const LoadedScene before = LoadScene(At("S")), after = LoadScene(At("T.arthro"));
  ASSERT_EQ(after.scene.tissues.size(), before.scene.tissues.size() + 1);
  const Tissue& tissue = after.scene.tissues.back();
  EXPECT_EQ(tissue.name, "medial meniscus");
  EXPECT_FALSE(tissue.mesh.empty());
  EXPECT_EQ(tissue.cuts.size(), 1u);
  EXPECT_EQ(tissue.regions.size(), 3u);
  EXPECT_GT(tissue.fixed.size(), 10u);
}

// Its tetrahedra are those of the displaced shape, and no cut is left to be made.
TEST_F(ModelJob, ADisplacedBucketHandleIsAShapeOfItsOwn) {
  const ProgramResult run =
      RunProgram(Whole("model medial-meniscus --tear bucket-handle --tear-displacement-mm 6 -o "
                       "@m.ply --scene @S --save-scene @T.arthro"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_GT(ReadSurface(At("m.ply"), 1.0).triangles.size(), 1000u);
  const LoadedScene after = LoadScene(At("T.arthro"));
  const Tissue& tissue = after.scene.tissues.back();
  EXPECT_FALSE(tissue.mesh.empty());
  EXPECT_TRUE(tissue.cuts.empty());
}

TEST_F(ModelJob, RefusesWhatDoesNotFitInOneSentence) {
  const std::pair<const char*, const char*> kCases[] = {
      {"model loose-body", "nothing would be written"},
      {"model loose-body --tear radial -o @m.ply", "only a meniscus is torn"},
      {"model loose-body --villi 3 -o @m.ply", "is no size of loose-body"},
      {"model medial-meniscus --body-width-mm 11 -o @m.ply", "body_width"},
      {"model medial-meniscus --tear radial --tear-reach-mm 15 --tear-position 0.5 -o @m.ply",
       "smaller reach"},
      {"model medial-meniscus --tear-reach-mm 5 -o @m.ply", "name its kind with --tear"},
      {"model medial-meniscus --tear radial --tear-displacement-mm 5 -o @m.ply",
       "leave out --tear-displacement-mm"},
      {"model medial-meniscus --tear bucket-handle --tear-displacement-mm 12 --tear-length-mm 70 "
       "-o "
       "@m.ply",
       "does not fit"},
      {"model loose-body --scene @S -o @m.ply", "give both"},
      {"model loose-body -o @new.vtu", "use .ply, .obj, .stl or .vtp"}};
  for (const auto& [arguments, words] : kCases) {
    const ProgramResult run = RunProgram(Whole(arguments));
    EXPECT_EQ(run.exit_code, 1) << arguments << "\n" << run.err;
    EXPECT_SAYS(run.err, words);
    EXPECT_FALSE(std::filesystem::exists(At("m.ply")));
  }
  const ProgramResult unknown = RunProgram(Whole("model medial-meniscus --tear parrot -o @m.ply"));
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_SAYS(unknown.err, "bucket-handle") << "it names the kinds that there are";
}

}  // namespace
}  // namespace arthro::test
