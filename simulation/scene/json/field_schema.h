// JSON Schema (draft 4) of structs by their one list of fields (core/options.h), beside the
// visitors that read and write them (field_json.h). Used for scene.json, rig files and lens files;
// the copies for other tools are in resources/schemas, and `arthroscene check --schema` prints
// them.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/scene/json/field_json.h"
#include "simulation/scene/projection.h"

namespace arthro {

// Heading of a file's schema: its name "arthroscene.KIND/N", a title and a description. `fields` is
// the SchemaOfFields of the file's struct. Keys that begin with "x-" are allowed.
nlohmann::ordered_json FileSchema(const std::string& name, const std::string& title,
                                  const std::string& description,
                                  const nlohmann::ordered_json& fields);

// Definitions that properties refer to: "optional_file", "file", "quaternion".
nlohmann::ordered_json FieldDefinitions();

namespace internal {

using Json = nlohmann::ordered_json;

Json Number(const Range& range, const char* unit);
Json WholeNumber(const Range& range);
Json List(const Json& items, int least, int most);
Json Reference(const char* definition);

template <class T>
Json ObjectOf(T value, bool is_one_kind = false);

// Describes each field of a struct as a property.
struct SchemaVisitor {
  // Only the choices that the struct has made are allowed, since the others have other fields.
  bool is_one_kind = false;
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
    Put(name, field, rule.rule, unit, help, needed || !IsAllowed(field, rule.rule));
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

  // A value that stands for "not given" may lie outside of its range; a reader need not know it.
  template <class T, class Rule>
  static bool IsAllowed(const T& field, const Rule& rule) {
    if constexpr (std::is_same_v<Rule, Range>) return Contains(rule, field);
    return true;
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
    } else if constexpr (internal::kIsMaybePoint<T>) {
      if (const std::string word = UnitInFile(unit); !word.empty())
        text += fmt::format(" In {}.", word);
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (!needed && !field.empty()) text += fmt::format(" \"{}\" if not given.", field);
    }
    return text;
  }

  template <class T, class Rule>
  Json Value(T& field, const Rule& rule, const char* unit, bool needed) {
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>>) {
      return Number(rule, unit);
    } else if constexpr (std::is_same_v<T, int>) {
      return WholeNumber(rule);
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
      Json words = Json::array();
      for (const auto& [value, word] : rule.words)
        if (!is_one_kind || value == field) words.push_back(word);
      return {{"enum", words}};
    } else if constexpr (std::is_same_v<Rule, Direction>) {
      Json json = List(Number(rule.each, unit), T::length(), T::length());
      json["not"]["enum"] = Json::array({Json::array({0, 0, 0})});
      return json;
    } else if constexpr (internal::kIsPoint<T>) {
      return List(Number(rule, unit), T::length(), T::length());
    } else if constexpr (internal::kIsMaybePoint<T>) {
      return List(Number(rule, unit), T::value_type::length(), T::value_type::length());
    } else if constexpr (std::is_same_v<T, glm::dquat>) {
      return Reference("quaternion");
    } else if constexpr (std::is_same_v<Rule, PointList>) {
      return List(List(Number(rule.each, unit), 3, 3), rule.least, rule.most);
    } else if constexpr (std::is_same_v<T, Projection>) {
      Json json;
      for (field.type = ProjectionType::kGnomonic; json["oneOf"].size() < 2;
           field.type = ProjectionType::kEquirectangular)
        json["oneOf"].push_back(ObjectOf(field, true));
      return json;
    } else if constexpr (std::is_same_v<Rule, NumberList>) {
      return {{"type", "array"}, {"items", {{"type", "number"}}}};
    } else if constexpr (std::is_same_v<Rule, TextList>) {
      return {{"type", "array"}, {"items", {{"type", "string"}, {"minLength", 1}}}};
    } else if constexpr (requires { field.emplace_back(); }) {
      return {{"type", "array"}, {"items", Element(typename T::value_type())}};
    } else if constexpr (internal::IsOptional<T>::value) {
      return ObjectOf(typename T::value_type());
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
      type[KindKey<Kind>()]["enum"] = {Kind::kType};
      type.update(own["properties"]);
      own["properties"] = type;
      if (!own.contains("required")) own["required"] = Json::array();
      own["required"].insert(own["required"].begin(), KindKey<Kind>());
      json["anyOf"].push_back(own);
    };
    (add(Kinds{}), ...);
    return json;
  }
};

template <class T>
Json ObjectOf(T value, bool is_one_kind) {
  SchemaVisitor visitor{is_one_kind};
  value.Visit(visitor);
  Json json{{"type", "object"}};
  if (!visitor.required.empty()) json["required"] = visitor.required;
  json["additionalProperties"] = false;
  json["properties"] = visitor.properties;
  return json;
}

}  // namespace internal

// {"type": "object", "required": […], "properties": {…}} of the fields that T::Visit lists.
template <class T>
nlohmann::ordered_json SchemaOfFields(const T& value) {
  return internal::ObjectOf(value);
}

}  // namespace arthro
