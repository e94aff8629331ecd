#include "simulation/scene/json/field_schema.h"

#include <cmath>

namespace arthro {
namespace internal {
namespace {

// A limit as a person writes it: 120, not 120.0.
Json Limit(double limit) {
  constexpr double kMostExact = 1e9;  // larger ones are written with an exponent
  const auto whole = static_cast<long long>(limit);
  return std::abs(limit) <= kMostExact && static_cast<double>(whole) == limit ? Json(whole)
                                                                              : Json(limit);
}

}  // namespace

Json Number(const Range& range, const char* unit) {
  const JsonLimits limits = LimitsInFile(range, unit);
  Json json{{"type", "number"}, {"minimum", Limit(limits.min)}};
  if (limits.above_min) json["exclusiveMinimum"] = true;
  json["maximum"] = Limit(limits.max);
  return json;
}

Json WholeNumber(const Range& range) {
  return {{"type", "integer"}, {"minimum", Limit(range.min)}, {"maximum", Limit(range.max)}};
}

Json List(const Json& items, int least, int most) {
  return {{"type", "array"}, {"minItems", least}, {"maxItems", most}, {"items", items}};
}

Json Reference(const char* definition) {
  return {{"$ref", std::string("#/definitions/") + definition}};
}

}  // namespace internal

using internal::Json;

Json FileSchema(const std::string& name, const std::string& title, const std::string& description,
                const Json& fields) {
  Json json;
  json["$schema"] = "http://json-schema.org/draft-04/schema#";
  json["id"] = name;
  json["title"] = title;
  json["description"] = description;
  json["type"] = "object";
  json["required"] = {"schema"};
  // A struct of which every field may be left out has no such list.
  if (fields.contains("required"))
    for (const Json& key : fields["required"]) json["required"].push_back(key);
  json["additionalProperties"]["not"] = Json::object();
  json["patternProperties"]["^x-"]["description"] = "Kept for other tools.";
  json["properties"]["schema"]["enum"] = {name};
  for (const auto& [key, value] : fields["properties"].items()) json["properties"][key] = value;
  return json;
}

Json FieldDefinitions() {
  Json json;
  Json& optional = json["optional_file"];
  optional["description"] =
      "A file in the scene's folder, by relative path with / between folders and no ..; empty for "
      "none.";
  optional["type"] = "string";
  for (const char* pattern : {"^/", "/$", "^.:", "\\\\", "^\\.\\.?$", "^\\.\\./", "/\\.\\./",
                              "/\\.\\.?$", "[\x01-\x1f\x7f]"})
    optional["not"]["anyOf"].push_back({{"pattern", pattern}});
  json["file"]["allOf"] = Json::array({internal::Reference("optional_file"), {{"minLength", 1}}});
  json["quaternion"] = internal::List(internal::Number({-1e3, 1e3}, ""), 4, 4);
  json["quaternion"]["not"]["enum"] = Json::array({Json::array({0, 0, 0, 0})});
  json["quaternion"]["description"] = "w, x, y, z; made unit on reading.";
  return json;
}

}  // namespace arthro
