#include "authoring/panorama/reported_view.h"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"

namespace arthro::authoring {
namespace {

using Json = nlohmann::json;

double NumberOf(const Json& json, const char* key, const std::filesystem::path& file) {
  const auto entry = json.find(key);
  if (entry == json.end() || !entry->is_number())
    throw Error(Code::kBadData,
                fmt::format("the report's \"panorama\" has no number \"{}\"; choose the report "
                            "that `arthroscene panorama --report` wrote",
                            key),
                file);
  return entry->get<double>();
}

Projection OverRelief(const Json& over, const std::filesystem::path& file) {
  const auto centre = over.find("centre_px");
  if (centre == over.end() || !centre->is_array() || centre->size() != 2 ||
      !centre->at(0).is_number() || !centre->at(1).is_number())
    throw Error(Code::kBadData, "the report's \"projection\" has no \"centre_px\" of two numbers",
                file);
  Projection projection;
  projection.type = ProjectionType::kEquirectangular;
  projection.px_per_deg = NumberOf(over, "px_per_deg", file);
  projection.centre_px = {centre->at(0).get<double>(), centre->at(1).get<double>()};
  return projection;
}

}  // namespace

ReportedView ReadReportedView(const std::filesystem::path& report) {
  const Json json = ParseJson(ReadWholeFile(report, kMostJsonBytes), Code::kBadData, report);
  const Json part = json.is_object() ? json.value("panorama", Json()) : Json();
  if (!part.is_object())
    throw Error(Code::kBadData, "there is no \"panorama\" in it; choose the report of a panorama",
                report);
  ReportedView view;
  if (const auto over = part.find("projection"); over != part.end() && over->is_object())
    view.projection = OverRelief(*over, report);
  else
    view.projection = {ProjectionType::kGnomonic,
                       {NumberOf(part, "cx", report), NumberOf(part, "cy", report)},
                       NumberOf(part, "focal_px", report)};
  view.width = NumberOf(part, "width", report);
  view.height = NumberOf(part, "height", report);
  return view;
}

}  // namespace arthro::authoring
