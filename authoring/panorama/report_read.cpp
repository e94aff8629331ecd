// Reading of a panorama's report (report_io.h).
#include <array>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "authoring/panorama/report_io.h"
#include "simulation/core/error.h"
#include "simulation/core/json_text.h"
#include "simulation/scene/json/lens_io.h"

namespace arthro::authoring {
namespace {

using AnyJson = nlohmann::json;

// Fault of a report, in words that continue "this is no report of a panorama: ".
struct ReportFault {
  std::string words;
};

const AnyJson& At(const AnyJson& json, const char* key) {
  if (!json.is_object()) throw ReportFault{fmt::format("\"{}\" stands in no object", key)};
  const auto value = json.find(key);
  if (value == json.end()) throw ReportFault{fmt::format("\"{}\" is missing", key)};
  return *value;
}

template <class T>
T Get(const AnyJson& json, const char* key) {
  try {
    return At(json, key).get<T>();
  } catch (const AnyJson::exception&) {
    throw ReportFault{fmt::format("\"{}\" is of the wrong kind", key)};
  }
}

template <class T>
T GetOr(const AnyJson& json, const char* key, T otherwise) {
  return json.is_object() && json.contains(key) ? Get<T>(json, key) : otherwise;
}

double NumberOr0(const AnyJson& json, const char* key) {
  return json.contains(key) && json.at(key).is_null() ? 0.0 : GetOr(json, key, 0.0);
}

const AnyJson& ListOr(const AnyJson& json, const char* key, const AnyJson& otherwise) {
  if (!json.contains(key)) return otherwise;
  if (!At(json, key).is_array()) throw ReportFault{fmt::format("\"{}\" is no list", key)};
  return At(json, key);
}

PinholeView ViewFromJson(const AnyJson& json) {
  return {Get<int>(json, "width"), Get<int>(json, "height"), Get<double>(json, "focal_px"),
          Get<double>(json, "cx"), Get<double>(json, "cy")};
}

FrameReport FrameFromJson(const AnyJson& json) {
  constexpr const char* kSkipped = "skipped: ";
  FrameReport frame;
  frame.index = Get<int>(json, "index");
  frame.source = Get<std::string>(json, "source");
  frame.is_placed = At(json, "status") == "placed";
  frame.reason = Get<std::string>(json, "reason");
  frame.is_usable = !frame.reason.starts_with(kSkipped);
  if (!frame.is_usable) frame.reason.erase(0, std::string_view(kSkipped).size());
  frame.component = Get<int>(json, "component");
  if (At(json, "panorama_from_rectified").is_array())
    frame.panorama_from_rectified = Get<std::array<double, 9>>(json, "panorama_from_rectified");
  frame.inliers = Get<int>(json, "inliers");
  frame.rms_px = NumberOr0(json, "rms_px");
  frame.expected_error_px = NumberOr0(json, "expected_error_px");
  return frame;
}

Projection ProjectionOverRelief(const AnyJson& json) {
  Projection projection;
  projection.type = ProjectionType::kEquirectangular;
  const auto centre = Get<std::vector<double>>(json, "centre_px");
  if (centre.size() != 2) throw ReportFault{"\"centre_px\" must be two numbers"};
  projection.centre_px = {centre[0], centre[1]};
  projection.px_per_deg = Get<double>(json, "px_per_deg");
  return projection;
}

void ReadPanorama(const AnyJson& json, PanoramaReport& report) {
  if (!json.contains("projection")) {
    report.panorama = ViewFromJson(json);
    return;
  }
  report.panorama.width = Get<int>(json, "width");
  report.panorama.height = Get<int>(json, "height");
  report.relief_radius = Get<double>(json, "radius");
  report.over_relief = ProjectionOverRelief(At(json, "projection"));
}

PanoramaReport Read(const AnyJson& json, const std::filesystem::path& file) {
  const AnyJson none = AnyJson::array();
  PanoramaReport report;
  report.footage = GetOr(json, "footage", std::string());
  report.is_partial = At(json, "status") == "partial";
  report.summary = Get<std::string>(json, "summary");
  report.lens = LensFromJson(At(json, "lens").dump(), file);
  report.is_lens_guessed = GetOr(json, "lens_is_guessed", false);
  if (json.contains("rectified")) report.rectified = ViewFromJson(At(json, "rectified"));
  ReadPanorama(At(json, "panorama"), report);
  report.mean_error_px = NumberOr0(json, "mean_error_px");
  report.max_error_px = NumberOr0(json, "max_error_px");
  report.drift_px = NumberOr0(json, "drift_px");
  report.detector = GetOr(json, "detector", std::string());
  report.seed = GetOr(json, "seed", 0);
  report.warnings = GetOr(json, "warnings", std::vector<std::string>());
  for (const AnyJson& row : ListOr(json, "components", none)) {
    PieceReport& piece = report.pieces.emplace_back();
    piece.component = Get<int>(row, "component");
    piece.frames = Get<int>(row, "frames");
    piece.file = Get<std::string>(row, "file");
    if (row.contains("panorama")) piece.panorama = ViewFromJson(At(row, "panorama"));
  }
  for (const AnyJson& row : ListOr(json, "clips", none))
    report.clips.push_back({Get<std::string>(row, "file"), Get<int>(row, "first_frame"),
                            Get<int>(row, "frames"), Get<int>(row, "usable"),
                            Get<int>(row, "placed")});
  for (const AnyJson& row : ListOr(json, "tied", none))
    report.tied.push_back({Get<int>(row, "index"), Get<int>(row, "pairs"),
                           Get<double>(row, "rms_px"), Get<double>(row, "expected_error_px"),
                           Get<bool>(row, "refined")});
  for (const AnyJson& row : ListOr(json, "text_boxes", none))
    report.text_boxes.push_back(
        {Get<int>(row, "x"), Get<int>(row, "y"), Get<int>(row, "width"), Get<int>(row, "height")});
  for (const AnyJson& row : Get<AnyJson::array_t>(json, "frames"))
    report.frames.push_back(FrameFromJson(row));
  for (std::size_t i = 0; i < report.clips.size(); ++i)
    for (FrameReport& frame : report.frames)
      if (frame.index >= report.clips[i].first_frame) frame.clip = static_cast<int>(i);
  using Costs = std::map<std::string, double>;
  for (const auto& [name, cost] : GetOr(json, "stages_ms", Costs()))
    report.stages.push_back({name, cost});
  report.peak_memory_mb = NumberOr0(json, "peak_memory_mb");
  return report;
}

ReportedView ReadView(const AnyJson& json) {
  if (json.contains("projection"))
    return {ProjectionOverRelief(At(json, "projection")), Get<int>(json, "width"),
            Get<int>(json, "height")};
  const PinholeView view = ViewFromJson(json);
  return {{ProjectionType::kGnomonic, {view.cx, view.cy}, view.focal_px}, view.width, view.height};
}

// Returns the value of `read`; a fault names the file and what to choose instead.
template <class Read>
auto InReport(const std::filesystem::path& file, const Read& read) {
  try {
    return read();
  } catch (const ReportFault& fault) {
    throw Error(Code::kBadData,
                fmt::format("this is no report of a panorama: {}; choose the one that "
                            "`arthroscene panorama --report` wrote",
                            fault.words),
                file);
  }
}

}  // namespace

PanoramaReport ReportFromJson(const std::string& text, const std::filesystem::path& file) {
  const AnyJson json = ParseJson(text, Code::kBadData, file);
  return InReport(file, [&] {
    PanoramaReport report = Read(json, file);
    // Options keep their order.
    const auto ordered = ParseOrderedJson(text, Code::kBadData);
    if (ordered.contains("options")) report.options = ordered["options"].dump();
    return report;
  });
}

ReportedView ViewFromReport(const std::string& text, const std::filesystem::path& file) {
  const AnyJson json = ParseJson(text, Code::kBadData, file);
  return InReport(file, [&] { return ReadView(At(json, "panorama")); });
}

}  // namespace arthro::authoring
