#include "authoring/depth/strokes/depth_strokes_io.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "authoring/depth/strokes/mend_depth.h"
#include "simulation/core/error.h"
#include "simulation/core/json_text.h"
#include "simulation/core/options_json.h"

namespace arthro::authoring {
namespace {

using Json = nlohmann::json;

std::vector<glm::dvec2> PointsFrom(const Json& json, const std::string& place,
                                   const std::filesystem::path& file) {
  const auto refuse = [&] {
    throw Error(Code::kBadData,
                place +
                    ".points must be a list of pairs of numbers, [[u, v], …], in shares of the "
                    "panorama's width",
                file);
  };
  if (!json.is_array()) refuse();
  std::vector<glm::dvec2> points;
  points.reserve(json.size());
  for (const Json& point : json) {
    if (!point.is_array() || point.size() != 2 || !point[0].is_number() || !point[1].is_number())
      refuse();
    points.emplace_back(point[0].get<double>(), point[1].get<double>());
  }
  return points;
}

}  // namespace

std::string StrokesText(const DepthStrokes& strokes) {
  Json list = Json::array();
  for (const DepthStroke& stroke : strokes) {
    Json json = JsonFromOptions(stroke);
    json["points"] = Json::array();
    for (const glm::dvec2& point : stroke.points) json["points"].push_back({point.x, point.y});
    list.push_back(std::move(json));
  }
  return Json{{"schema", kStrokesSchema}, {"strokes", std::move(list)}}.dump();
}

DepthStrokes StrokesFromText(std::string_view text, const std::filesystem::path& file) {
  const Json json = ParseJson(text, Code::kBadData, file);
  if (!json.is_object() || json.value("schema", Json()) != kStrokesSchema)
    throw Error(Code::kBadData,
                fmt::format("it holds no strokes of this program: \"schema\" must be \"{}\"",
                            kStrokesSchema),
                file);
  const auto list = json.find("strokes");
  if (list == json.end() || !list->is_array())
    throw Error(Code::kBadData, "\"strokes\" must be a list of strokes", file);
  DepthStrokes strokes;
  for (const Json& entry : *list) {
    const std::string place = fmt::format("strokes[{}]", strokes.size());
    if (!entry.is_object()) throw Error(Code::kBadData, place + " must be an object", file);
    Json fields = entry;
    fields.erase("points");
    DepthStroke stroke = OptionsFromJson<DepthStroke>(fields, file);
    stroke.points = PointsFrom(entry.value("points", Json()), place, file);
    strokes.push_back(std::move(stroke));
  }
  try {
    CheckStrokes(strokes);
  } catch (const Error& error) {
    throw Error(Code::kBadData, error.what(), file);
  }
  return strokes;
}

}  // namespace arthro::authoring
