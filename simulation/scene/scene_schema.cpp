#include "simulation/scene/scene_schema.h"

#include "simulation/scene/field_json.h"
#include "simulation/scene/scene.h"
#include "simulation/scene/scene_json.h"
#include "simulation/scene/scene_migration.h"

namespace arthro {
namespace {

using Json = nlohmann::ordered_json;

// A limit as a person writes it: 120, not 120.0.
Json Limit(double limit) {
  constexpr double kMostExact = 1e9;  // larger ones are written with an exponent
  const auto whole = static_cast<long long>(limit);
  return std::abs(limit) <= kMostExact && static_cast<double>(whole) == limit ? Json(whole)
                                                                              : Json(limit);
}

Json Number(const Range& range, const char* unit) {
  const JsonLimits limits = LimitsInFile(range, unit);
  Json json{{"type", "number"}, {"minimum", Limit(limits.min)}};
  if (limits.above_min) json["exclusiveMinimum"] = true;
  json["maximum"] = Limit(limits.max);
  return json;
}

Json List(const Json& items, int least, int most) {
  return {{"type", "array"}, {"minItems", least}, {"maxItems", most}, {"items", items}};
}

Json Reference(const char* definition) {
  return {{"$ref", std::string("#/definitions/") + definition}};
}

template <class T>
Json ObjectOf(T value);

// Describes each field of a struct as a property.
struct SchemaVisitor {
  Json properties = Json::object(), required = Json::array();

  template <class T, class Rule>
  void operator()(const char* name, T& field, const Rule& rule, const char* unit,
                  const char* help) {
    Put(name, field, rule, unit, help, false);
  }

  template <class T, class Rule>
  void Put(const char* name, T& field, const Required<Rule>& rule, const char* unit,
           const char* help, bool) {
    required.push_back(name);
    Put(name, field, rule.rule, unit, help, true);
  }
  template <class T, class Rule>
  void Put(const char* name, T& field, const Always<Rule>& rule, const char* unit, const char* help,
           bool needed) {
    Put(name, field, rule.rule, unit, help, needed);
  }
  template <class T, class V, class Rule>
  void Put(const char* name, T& field, const LeftOutAt<V, Rule>& rule, const char* unit,
           const char* help, bool needed) {
    if constexpr (std::is_enum_v<T>) {
      Json words = Json::array();
      for (const auto& [value, word] : rule.rule.words) words.push_back(word);
      properties[name] = {{"enum", words}, {"description", help}};
    } else {
      Put(name, field, rule.rule, unit, help, needed);
    }
  }
  template <class T, class Rule>
  void Put(const char* name, T& field, const OnlyIf<Rule>& rule, const char* unit, const char* help,
           bool needed) {
    if (rule.holds) Put(name, field, rule.rule, unit, help, needed);
  }
  template <class T, class Rule>
  void Put(const char* name, T& field, const Rule& rule, const char* unit, const char* help,
           bool needed) {
    if constexpr (std::is_same_v<Rule, Name>) required.push_back(name);
    Json json = Value(field, rule, unit, needed);
    // Draft 4 ignores what stands beside a reference.
    if (json.contains("$ref")) json = {{"allOf", Json::array({json})}};
    json["description"] = Description(field, unit, help, needed);
    properties[name + std::string(FileBorder(unit).suffix)] = std::move(json);
  }

  template <class T>
  static std::string Description(const T& field, const char* unit, const char* help, bool needed) {
    std::string text = help;
    if constexpr (std::is_same_v<T, double>) {
      const double shown = std::string_view(unit) == "rad" ? FileDegrees(field) : field;
      const std::string word = UnitInFile(unit);
      text += needed ? (word.empty() ? "" : fmt::format(" In {}.", word))
                     : fmt::format(" {}{}{} if not given.", shown, word.empty() ? "" : " ", word);
    } else if constexpr (std::is_same_v<T, bool>) {
      text += fmt::format(" {} if not given.", field);
    } else if constexpr (internal::kIsPoint<T>) {
      if (const std::string word = UnitInFile(unit); !word.empty())
        text += fmt::format(" In {}.", word);
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (!needed && !field.empty()) text += fmt::format(" \"{}\" if not given.", field);
    }
    return text;
  }

  template <class T, class Rule>
  static Json Value(T& field, const Rule& rule, const char* unit, bool needed) {
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>>) {
      return Number(rule, unit);
    } else if constexpr (std::is_same_v<T, bool>) {
      return {{"type", "boolean"}};
    } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
      return Reference(needed ? "file" : "optional_file");
    } else if constexpr (std::is_same_v<Rule, Words>) {
      return {{"enum", std::vector<std::string>(rule.words.begin(), rule.words.end())}};
    } else if constexpr (std::is_same_v<Rule, Name>) {
      Json json{{"type", "string"}, {"minLength", 1}};
      if (rule.is_table_cell) json["pattern"] = "^[^,\"\\r\\n]+$";
      if (!rule.reserved.empty())
        json["not"]["enum"] = std::vector<std::string>(rule.reserved.begin(), rule.reserved.end());
      return json;
    } else if constexpr (std::is_same_v<T, std::string>) {
      Json json{{"type", "string"}};
      if (needed) json["minLength"] = 1;
      return json;
    } else if constexpr (std::is_enum_v<T>) {
      // Each value of a choice has its own fields (OneOfEach), so only that value is allowed.
      for (const auto& [value, word] : rule.words)
        if (value == field) return {{"enum", {word}}};
      return {};
    } else if constexpr (std::is_same_v<Rule, Direction>) {
      Json json = List(Number(rule.each, unit), T::length(), T::length());
      json["not"]["enum"] = Json::array({Json::array({0, 0, 0})});
      return json;
    } else if constexpr (internal::kIsPoint<T>) {
      return List(Number(rule, unit), T::length(), T::length());
    } else if constexpr (std::is_same_v<T, glm::dquat>) {
      return Reference("quaternion");
    } else if constexpr (std::is_same_v<Rule, PointList>) {
      return List(List(Number(rule.each, unit), 3, 3), rule.least, rule.most);
    } else if constexpr (std::is_same_v<T, Projection>) {
      Json json;
      for (field.type = ProjectionType::kGnomonic; json["oneOf"].size() < 2;
           field.type = ProjectionType::kEquirectangular)
        json["oneOf"].push_back(ObjectOf(field));
      return json;
    } else if constexpr (requires { field.emplace_back(); }) {
      return {{"type", "array"}, {"items", Element(typename T::value_type())}};
    } else {
      return ObjectOf(field);
    }
  }

  template <class T>
  static Json Element(T element) {
    return ObjectOf(element);
  }
  template <class... Kinds>
  static Json Element(const std::variant<Kinds...>&) {
    Json json;
    const auto add = [&]<class Kind>(Kind kind) {
      Json own = ObjectOf(kind);
      own["description"] = Kind::kHelp;
      Json type;
      type["type"]["enum"] = {Kind::kType};
      type.update(own["properties"]);
      own["properties"] = type;
      own["required"].insert(own["required"].begin(), "type");
      json["anyOf"].push_back(own);
    };
    (add(Kinds{}), ...);
    return json;
  }
};

template <class T>
Json ObjectOf(T value) {
  SchemaVisitor visitor;
  value.Visit(visitor);
  Json json{{"type", "object"}};
  if (!visitor.required.empty()) json["required"] = visitor.required;
  json["additionalProperties"] = false;
  json["properties"] = visitor.properties;
  return json;
}

Json Definitions() {
  Json json;
  Json& optional = json["optional_file"];
  optional["description"] =
      "A file in the scene's folder, by relative path with / between folders and no ..; empty for "
      "none.";
  optional["type"] = "string";
  for (const char* pattern : {"^/", "/$", "^.:", "\\\\", "^\\.\\.?$", "^\\.\\./", "/\\.\\./",
                              "/\\.\\.?$", "[\x01-\x1f\x7f]"})
    optional["not"]["anyOf"].push_back({{"pattern", pattern}});
  json["file"]["allOf"] = Json::array({Reference("optional_file"), {{"minLength", 1}}});
  json["quaternion"] = List(Number({-1e3, 1e3}, ""), 4, 4);
  json["quaternion"]["not"]["enum"] = Json::array({Json::array({0, 0, 0, 0})});
  json["quaternion"]["description"] = "w, x, y, z; made unit on reading.";
  return json;
}

}  // namespace

std::string SceneSchemaText() {
  const std::string name = SceneSchemaName(kSceneVersion);
  Json own = ObjectOf(Scene());
  Json json;
  json["$schema"] = "http://json-schema.org/draft-04/schema#";
  json["id"] = name;
  json["title"] = fmt::format("Arthroscene scene, version {}", kSceneVersion);
  json["description"] =
      "scene.json of a scene folder. Lengths in metres; angles in degrees under keys that end in "
      "_deg. Directions and positions in the portal frame: origin at the scope portal, +z into the "
      "joint, +x to the viewer's right, +y down. This schema cannot express that names of tissues, "
      "names of regions in a tissue and ids of tasks are unique.";
  json["type"] = "object";
  json["required"] = {"schema"};
  for (const Json& key : own["required"]) json["required"].push_back(key);
  json["additionalProperties"]["not"] = Json::object();
  json["patternProperties"]["^x-"]["description"] = "Kept for other tools.";
  json["properties"]["schema"]["enum"] = {name};
  for (const auto& [key, value] : own["properties"].items()) json["properties"][key] = value;
  // Older writers repeat the length of the scope's rod here.
  Json& rod = json["properties"]["rig"]["properties"]["scope"]["properties"]["rod_length"];
  rod = Number(kLength, "m");
  rod["description"] = "If given, the same as scope.rod_length.";
  json["definitions"] = Definitions();
  return PrettyJson(json);
}

}  // namespace arthro
