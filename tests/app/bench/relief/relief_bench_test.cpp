#include "app/bench/relief/relief_bench.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/bench/relief/touch_error.h"

namespace arthro::app {
namespace {

test::TrueSurface Surface() {
  test::CavityOptions options;
  options.frames = 5;
  return test::SurfaceOf(test::TruthOf(options));
}

TEST(TouchError, OfTheTrueSurfaceIsNone) {
  const test::TrueSurface truth = Surface();
  const TouchError error = MeasureTouches({truth.radius, {}}, truth, 100, 3);
  EXPECT_EQ(error.touches, 100);
  EXPECT_EQ(error.rms, 0.0);
  EXPECT_EQ(error.felt, 1.0);
  // 500 N/m at depths between 0.2 and 2 mm: 0.1 to 1 N.
  EXPECT_GT(error.true_rms, 0.3);
  EXPECT_LT(error.true_rms, 1.0);
}

// K times the distance, along normals that hardly change; a surface that is nowhere known gives no
// force.
TEST(TouchError, OfASurfaceThatIsTooNearIsItsDistance) {
  const test::TrueSurface truth = Surface();
  test::FoundSurface near{truth.radius, {}}, unknown = near;
  for (float& r : near.radius.relief) r -= 1e-3f;
  for (float& r : unknown.radius.relief) r = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NEAR(MeasureTouches(near, truth, 100, 3).rms, 0.5, 0.05);
  const TouchError none = MeasureTouches(unknown, truth, 100, 3);
  EXPECT_EQ(none.felt, 0.0);
  EXPECT_EQ(none.rms, none.true_rms);
}

TEST(ReliefBench, AResultWithoutASurfaceIsNullInJson) {
  ReliefBench bench;
  ReliefBenchRow row;
  row.clip = "easy";
  row.way = "motion";
  row.outcome = "still";
  row.rmse_mm = std::numeric_limits<double>::quiet_NaN();
  bench.rows = {row};
  EXPECT_TRUE(JsonOf(bench).at("rows").at(0).at("rmse_mm").is_null());
  EXPECT_NE(TableOf(bench).find("still"), std::string::npos);
  EXPECT_NE(PlotOf(bench).find("<svg"), std::string::npos);
}

}  // namespace
}  // namespace arthro::app
