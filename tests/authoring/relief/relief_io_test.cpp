#include "authoring/relief/relief_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "authoring/relief/relief_options.h"
#include "simulation/core/options_json.h"
#include "tests/support/schema_fault.h"

namespace arthro::authoring {
namespace {

using nlohmann::json;

ReliefReport SampleReport() {
  ReliefReport report;
  report.footage = "clip";
  report.points = 1200;
  report.rms_px = 0.31234567;
  report.has_pivot = true;
  report.pivot_miss = 4e-4;
  report.median_insertion = 0.018;
  report.shaft_spread = 0.2;
  report.head_turn = -0.01;
  report.scale_source = "length";
  report.scale = 1.02;
  report.radius = 0.05;
  report.projection.type = ProjectionType::kEquirectangular;
  report.projection.centre_px = {99.5, 79.5};
  report.projection.px_per_deg = 2;
  report.width = 200;
  report.height = 160;
  report.coverage = 0.83;
  report.confidence_histogram = {10, 9, 8, 7, 6, 5, 4, 3, 2, 1};
  PosedFrame posed;
  posed.source = "0000.png";
  posed.is_posed = true;
  posed.rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  posed.centre = {0.001, 0.002, 0.018};
  posed.sigma_m = 1e-5;
  posed.sigma_rad = 1e-3;
  posed.tracks = 300;
  posed.inliers = 280;
  posed.rms_px = 0.3;
  PosedFrame blank;
  blank.index = 1;
  blank.source = "0001.png";
  blank.reason = "blank: it is black";
  report.frames = {posed, blank};
  report.stages = {{"tracks", 12.3456}, {"sweep", 99}};
  report.peak_memory_mb = 123.4;
  report.warnings = {"no length was given"};
  report.options = JsonFromOptions(ReliefOptions()).dump();
  return report;
}

TEST(ReliefIo, AReportKeepsItsSchema) {
  EXPECT_EQ(test::SchemaFault("relief-1", JsonFromReliefReport(SampleReport())), "");
  EXPECT_EQ(test::SchemaFault("relief-1", JsonFromReliefReport({})), "");
}

TEST(ReliefIo, AReportOfARefusedClipKeepsItsSchema) {
  ReliefReport report = SampleReport();
  report.verdict = {"still", "The scope does not move; record it while it turns.",
                    "median motion of a track, px", 0.1, 0.5};
  report.frames = {report.frames[1]};
  report.width = report.height = 0;
  EXPECT_EQ(test::SchemaFault("relief-1", JsonFromReliefReport(report)), "");
}

TEST(ReliefIo, PosesKeepTheirSchema) {
  const std::string poses = JsonFromPoses(SampleReport());
  EXPECT_EQ(test::SchemaFault("poses-1", poses), "");
  EXPECT_EQ(json::parse(poses).at("frames").size(), 1u) << "the frame without a pose is left out";
  EXPECT_EQ(test::SchemaFault("poses-1", JsonFromPoses({})), "");
}

TEST(ReliefIo, TheSchemasRefuseOtherDocuments) {
  json report = json::parse(JsonFromReliefReport(SampleReport()));
  for (const char* key : {"schema", "status", "verdict", "frames", "coverage"}) {
    json without = report;
    without.erase(key);
    EXPECT_NE(test::SchemaFault("relief-1", without.dump()), "") << key;
  }
  report["frames"][0]["R"] = {1, 2, 3};
  EXPECT_EQ(test::SchemaFault("relief-1", report.dump()), "#/frames/0/R minItems");
  json poses = json::parse(JsonFromPoses(SampleReport()));
  poses["frames"][0]["C"][0] = nullptr;
  EXPECT_NE(test::SchemaFault("poses-1", poses.dump()), "");
}

}  // namespace
}  // namespace arthro::authoring
