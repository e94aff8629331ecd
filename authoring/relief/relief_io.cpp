#include "authoring/relief/relief_io.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "simulation/core/error.h"
#include "simulation/core/json_text.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

using Json = nlohmann::ordered_json;

double Rounded(double value) { return std::round(value * 1e6) / 1e6; }

Json JsonFromFrame(const PosedFrame& frame) {
  Json json = {{"index", frame.index},
               {"source", frame.source},
               {"status", frame.is_posed ? "posed" : "rejected"},
               {"reason", frame.reason},
               {"tracks", frame.tracks},
               {"inliers", frame.inliers},
               {"rms_px", Rounded(frame.rms_px)}};
  if (!frame.is_posed) return json;
  if (frame.expected_error_px > 0) json["expected_error_px"] = Rounded(frame.expected_error_px);
  json["R"] = frame.rotation;
  json["C"] = frame.centre;
  json["sigma"] = frame.sigma_m;
  json["sigma_deg"] = DegreesFromRadians(frame.sigma_rad);
  return json;
}

}  // namespace

std::string JsonFromReliefReport(const ReliefReport& report) {
  Json json;
  json["schema"] = "arthroscene.relief/1";
  json["status"] = report.verdict.is_measured() ? "measured" : "refused";
  json["verdict"] = {{"kind", report.verdict.kind}};
  if (!report.verdict.is_measured()) {
    json["verdict"]["reason"] = report.verdict.sentence;
    json["verdict"]["test"] = report.verdict.test;
    json["verdict"]["value"] = Rounded(report.verdict.value);
    json["verdict"]["limit"] = report.verdict.limit;
  }
  json["footage"] = report.footage;
  json["points"] = report.points;
  json["rms_px"] = Rounded(report.rms_px);
  json["pivot"] = {{"status", report.has_pivot ? "measured" : "assumed"},
                   {"miss", report.pivot_miss},
                   {"median_insertion", report.median_insertion},
                   {"shaft_spread_deg", DegreesFromRadians(report.shaft_spread)},
                   {"head_turn_deg", DegreesFromRadians(report.head_turn)}};
  json["scale"] = {{"source", report.scale_source}, {"factor", report.scale}};
  if (report.width > 0)
    json["backdrop"] = {
        {"width", report.width},
        {"height", report.height},
        {"radius", report.radius},
        {"projection",
         {{"type", "equirectangular"},
          {"centre_px", {report.projection.centre_px.x, report.projection.centre_px.y}},
          {"px_per_deg", report.projection.px_per_deg}}}};
  json["coverage"] = Rounded(report.coverage);
  json["origin"] = {{"measured", Rounded(report.measured_share)},
                    {"brightness", Rounded(report.brightness_share)},
                    {"interpolated", Rounded(report.interpolated_share)}};
  json["confidence_histogram"] = report.confidence_histogram;
  json["warnings"] = report.warnings;
  json["frames"] = Json::array();
  for (const PosedFrame& frame : report.frames) json["frames"].push_back(JsonFromFrame(frame));
  json["stages_ms"] = Json::object();
  for (const StageCost& stage : report.stages)
    json["stages_ms"][stage.name] = std::round(stage.cpu_ms);
  json["peak_memory_mb"] = std::round(report.peak_memory_mb);
  if (!report.options.empty()) json["options"] = ParseJson(report.options, Code::kBadData, {});
  return json.dump(1) + "\n";
}

std::string JsonFromPoses(const ReliefReport& report) {
  Json json;
  json["schema"] = "arthroscene.poses/1";
  json["unit"] = "m";
  json["scale"] = report.scale_source;
  if (report.has_pivot) json["pivot"] = {0.0, 0.0, 0.0};
  json["frames"] = Json::array();
  for (const PosedFrame& frame : report.frames)
    if (frame.is_posed)
      json["frames"].push_back(
          {{"index", frame.index}, {"R", frame.rotation}, {"C", frame.centre}});
  return json.dump(1) + "\n";
}

}  // namespace arthro::authoring
