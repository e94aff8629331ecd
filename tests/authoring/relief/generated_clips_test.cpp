// A clip that another program rendered, with truth that only tests/support reads: poses and surface
// within goals.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "authoring/relief/make_relief.h"
#include "simulation/core/units.h"
#include "tests/support/relief/surface_score.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPython = "/usr/bin/python3";  // Debian's, which has the packages

bool HasPython() {
  return std::system(fmt::format("{} -c 'import numpy, cv2' >/dev/null 2>&1", kPython).c_str()) ==
         0;
}

bool Generate(const fs::path& generator, const fs::path& folder, const std::string& flags) {
  return std::system(fmt::format("{} -B '{}' '{}' {} >/dev/null 2>&1", kPython, generator.string(),
                                 folder.string(), flags)
                         .c_str()) == 0;
}

// Cells that count as measured only.
ReliefResult MeasuredPartOf(ReliefResult result) {
  for (std::size_t i = 0; i < result.relief.relief.size(); ++i)
    if (result.origin.origin[i] != ReliefOrigin::kMeasured)
      result.relief.relief[i] = std::numeric_limits<float>::quiet_NaN();
  return result;
}

// The preset easy at two thirds of its width and with 20 of its 28 frames, so that it takes
// seconds: a pixel is half as large again and the path shorter, so that the goals of the preset
// medium hold.
TEST(GeneratedClip, IsPosedAndMeasuredWithinTheGoals) {
  ARTHRO_REQUIRE_SHARED(generator, "reference/cavity/gen_cavity.py");
  if (!HasPython())
    GTEST_SKIP()
        << "SKIPPED: python3-numpy and python3-opencv are not installed, so that the poses "
           "of a clip of another program are not tested here";
  const test::TempFolder folder;
  ASSERT_TRUE(Generate(generator, folder.path(),
                       "--preset easy --seed 502 --set n=20 turns=1.07 w=320 h=266 circle=126 "
                       "cx_off=1.3 cy_off=-1"));
  const test::CavityTruth truth = test::ReadCavityTruth(folder.path());
  const test::TrueSurface surface = test::SurfaceOf(truth);
  ReliefRequest request;
  request.footage = folder / "frames";
  request.lens = truth.lens;
  request.options.view_angle = truth.view_angle;
  request.draws_panorama = false;
  const ReliefResult result = MakeRelief(request, {});
  ASSERT_TRUE(result.report.verdict.is_measured()) << result.report.verdict.sentence;

  const test::PoseScore poses = test::ScorePoses(result.report, truth);
  EXPECT_EQ(poses.posed, 20);
  EXPECT_LT(MmFromMetres(poses.path), 0.15) << "mm";
  EXPECT_LT(DegreesFromRadians(poses.rotation), 1);
  EXPECT_LT(MmFromMetres(poses.portal), 0.5) << "mm";

  const auto found = test::SurfaceOf(MeasuredPartOf(result), truth, surface);
  ASSERT_TRUE(found);
  const test::SurfaceScore score = test::ScoreSurface(*found, surface);
  EXPECT_GT(score.coverage, 0.7);
  EXPECT_GT(score.within_1mm, 0.8);
  EXPECT_GT(score.spearman, 0.93);
}

}  // namespace
}  // namespace arthro::authoring
