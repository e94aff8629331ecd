// The whole way from pictures to relief, on small clips with known truth.
#include "authoring/relief/make/make_relief.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "authoring/relief/relief_io.h"
#include "simulation/core/error.h"
#include "simulation/core/json_text.h"
#include "tests/authoring/relief/relief_truth.h"
#include "tests/support/relief/cavity_clip.h"
#include "tests/support/schema_fault.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

ReliefRequest RequestOf(const std::filesystem::path& folder, const test::CavityOptions& clip) {
  ReliefRequest request;
  request.footage = folder;
  request.lens = test::CavityLens();
  request.options.insertion = test::MedianInsertion(test::CavityPoses(clip));
  request.options.points = 400;
  return request;
}

bool IsSame(const DepthMap& a, const DepthMap& b) {
  return a.width == b.width && a.height == b.height &&
         std::memcmp(a.relief.data(), b.relief.data(), a.relief.size() * sizeof(float)) == 0;
}

TEST(MakeRelief, MeasuresASmallCavityAndRepeatsItToTheBit) {
  const test::TempFolder folder;
  const test::CavityOptions clip;
  test::WriteCavityClip(folder.path(), clip);
  ReliefRequest request = RequestOf(folder.path(), clip);
  const ReliefResult result = MakeRelief(request, {});
  ASSERT_TRUE(result.report.verdict.is_measured()) << result.report.verdict.sentence;
  EXPECT_TRUE(result.report.has_pivot);
  EXPECT_EQ(result.report.scale_source, "assumed");
  for (const PosedFrame& frame : result.report.frames) EXPECT_TRUE(frame.is_posed) << frame.reason;
  EXPECT_EQ(test::SchemaFault("relief-1", JsonFromReliefReport(result.report)), "");
  EXPECT_EQ(test::SchemaFault("poses-1", JsonFromPoses(result.report)), "");
  EXPECT_GT(result.report.coverage, 0.3);
  // The goal of the hardest clips: 6 % of the range. At 240 px and with this smooth texture the
  // light that moves with the tip pulls the tracks.
  constexpr double kGoal = 0.06, kMiddleRadius = 0.040;  // m, of the cavity
  EXPECT_LT(test::MedianRadialError(result, clip),
            kGoal * (kMiddleRadius - request.options.insertion))
      << "m";

  // Every cell that a frame sees has a value, an error and an origin; all others have none.
  int unseen = 0, measured = 0;
  for (int y = 0; y < result.relief.height; ++y)
    for (int x = 0; x < result.relief.width; ++x) {
      const bool is_known = !std::isnan(result.relief.at(x, y));
      EXPECT_EQ(is_known, result.sigma.at(x, y) > 0);
      EXPECT_EQ(is_known, result.origin.at(x, y) != ReliefOrigin::kNone);
      if (result.origin.at(x, y) == ReliefOrigin::kMeasured) {
        ++measured;
        EXPECT_GE(result.confidence.at(x, y), request.options.least_confidence);
      }
      unseen += !is_known;
    }
  EXPECT_GT(measured, 0);
  EXPECT_GT(unseen, 0) << "the corners of the grid";
  EXPECT_EQ(result.picture.width, result.relief.width * result.picture_scale);
  EXPECT_EQ(result.picture.height, result.relief.height * result.picture_scale);

  request.options.threads = 4;
  const ReliefResult again = MakeRelief(request, {});
  EXPECT_TRUE(IsSame(result.relief, again.relief));
  EXPECT_TRUE(IsSame(result.sigma, again.sigma));
  EXPECT_TRUE(IsSame(result.confidence, again.confidence));
  EXPECT_EQ(result.origin.origin, again.origin.origin);
  EXPECT_EQ(result.picture.rgba, again.picture.rgba);
  EXPECT_EQ(JsonFromPoses(result.report), JsonFromPoses(again.report));

  // A known length sets the scale of everything.
  const int x = result.relief.width / 2, y = result.relief.height / 2;
  ASSERT_FALSE(std::isnan(result.relief.at(x, y)) || std::isnan(result.relief.at(x + 8, y)));
  const auto point = [&](int column) {
    const glm::dvec3 d = DirectionFromPixel(result.report.projection, {column, y});
    return d * (result.report.radius - result.relief.at(column, y));
  };
  const double length = glm::length(point(x) - point(x + 8));
  request.lengths = {{2 * length, {x, y}, {x + 8, y}}};
  const ReliefResult scaled = MakeRelief(request, {});
  EXPECT_EQ(scaled.report.scale_source, "length");
  EXPECT_NEAR(scaled.report.radius, 2 * result.report.radius, 1e-4 * result.report.radius);
  EXPECT_NEAR(scaled.report.frames[3].centre[2], 2 * result.report.frames[3].centre[2], 1e-6);
  request.lengths = {{length, {-5, 0}, {x, y}}};
  EXPECT_THROW(MakeRelief(request, {}), Error);
}

TEST(MakeRelief, RefusesAClipThatStandsStill) {
  const test::TempFolder folder;
  test::CavityOptions clip;
  clip.motion = test::ScopeMotion::kStill;
  clip.frames = 5;
  test::WriteCavityClip(folder.path(), clip);
  const ReliefResult result = MakeRelief(RequestOf(folder.path(), clip), {});
  EXPECT_FALSE(result.report.verdict.is_measured());
  EXPECT_TRUE(result.relief.empty());
  const auto json = ParseJson(JsonFromReliefReport(result.report), Code::kBadData, {});
  EXPECT_EQ(json["status"], "refused");
  EXPECT_FALSE(json["verdict"]["reason"].get<std::string>().empty());
}

}  // namespace
}  // namespace arthro::authoring
