// Reading of a panorama's report (report_io.h).
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "authoring/panorama/report_io.h"
#include "simulation/core/error.h"
#include "simulation/core/json_text.h"
#include "simulation/scene/json/lens_io.h"

namespace arthro::authoring {
namespace {

using Json = nlohmann::json;

PinholeView ViewFromJson(const Json& json) {
  return {json.at("width"), json.at("height"), json.at("focal_px"), json.at("cx"), json.at("cy")};
}

double NumberOr0(const Json& json, const char* key) {
  const auto value = json.find(key);
  return value == json.end() || value->is_null() ? 0.0 : value->get<double>();
}

FrameReport FrameFromJson(const Json& json) {
  constexpr const char* kSkipped = "skipped: ";
  FrameReport frame;
  frame.index = json.at("index");
  frame.source = json.at("source");
  frame.is_placed = json.at("status") == "placed";
  frame.reason = json.at("reason");
  frame.is_usable = !frame.reason.starts_with(kSkipped);
  if (!frame.is_usable) frame.reason.erase(0, std::string_view(kSkipped).size());
  frame.component = json.at("component");
  if (const Json& place = json.at("panorama_from_rectified"); place.is_array())
    frame.panorama_from_rectified = place.get<std::array<double, 9>>();
  frame.inliers = json.at("inliers");
  frame.rms_px = NumberOr0(json, "rms_px");
  frame.expected_error_px = NumberOr0(json, "expected_error_px");
  return frame;
}

void ReadPanorama(const Json& json, PanoramaReport& report) {
  if (!json.contains("projection")) {
    report.panorama = ViewFromJson(json);
    return;
  }
  report.panorama.width = json.at("width");
  report.panorama.height = json.at("height");
  report.relief_radius = json.at("radius");
  const Json& over = json.at("projection");
  Projection& projection = report.over_relief.emplace();
  projection.type = ProjectionType::kEquirectangular;
  projection.centre_px = {over.at("centre_px").at(0), over.at("centre_px").at(1)};
  projection.px_per_deg = over.at("px_per_deg");
}

PanoramaReport Read(const Json& json, const std::filesystem::path& file) {
  PanoramaReport report;
  report.footage = json.value("footage", "");
  report.is_partial = json.at("status") == "partial";
  report.summary = json.at("summary");
  report.lens = LensFromJson(json.at("lens").dump(), file);
  report.is_lens_guessed = json.value("lens_is_guessed", false);
  if (json.contains("rectified")) report.rectified = ViewFromJson(json.at("rectified"));
  ReadPanorama(json.at("panorama"), report);
  report.mean_error_px = NumberOr0(json, "mean_error_px");
  report.max_error_px = NumberOr0(json, "max_error_px");
  report.drift_px = NumberOr0(json, "drift_px");
  report.detector = json.value("detector", "");
  report.seed = json.value("seed", 0);
  report.warnings = json.value("warnings", std::vector<std::string>());
  for (const Json& row : json.value("components", Json::array())) {
    PieceReport& piece = report.pieces.emplace_back();
    piece.component = row.at("component");
    piece.frames = row.at("frames");
    piece.file = row.at("file");
    if (row.contains("panorama")) piece.panorama = ViewFromJson(row.at("panorama"));
  }
  for (const Json& row : json.value("clips", Json::array()))
    report.clips.push_back({row.at("file"), row.at("first_frame"), row.at("frames"),
                            row.at("usable"), row.at("placed")});
  for (const Json& row : json.value("tied", Json::array()))
    report.tied.push_back({row.at("index"), row.at("pairs"), row.at("rms_px"),
                           row.at("expected_error_px"), row.at("refined")});
  for (const Json& row : json.value("text_boxes", Json::array()))
    report.text_boxes.push_back({row.at("x"), row.at("y"), row.at("width"), row.at("height")});
  for (const Json& row : json.at("frames")) report.frames.push_back(FrameFromJson(row));
  for (std::size_t i = 0; i < report.clips.size(); ++i)
    for (FrameReport& frame : report.frames)
      if (frame.index >= report.clips[i].first_frame) frame.clip = static_cast<int>(i);
  const Json stages = json.value("stages_ms", Json::object());
  for (const auto& [name, cost] : stages.items())
    report.stages.push_back({name, cost.get<double>()});
  report.peak_memory_mb = NumberOr0(json, "peak_memory_mb");
  return report;
}

}  // namespace

PanoramaReport ReportFromJson(const std::string& text, const std::filesystem::path& file) {
  const Json json = ParseJson(text, Code::kBadData, file);
  try {
    PanoramaReport report = Read(json, file);
    // Options keep their order.
    const auto ordered = ParseOrderedJson(text, Code::kBadData);
    if (ordered.contains("options")) report.options = ordered["options"].dump();
    return report;
  } catch (const Json::exception& fault) {
    throw Error(Code::kBadData,
                fmt::format("this is no report of a panorama ({}); choose the one that "
                            "`arthroscene panorama --report` wrote",
                            fault.what()),
                file);
  }
}

}  // namespace arthro::authoring
