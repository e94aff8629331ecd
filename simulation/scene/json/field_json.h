// Scene fields from and to JSON by the one list of fields of each struct (core/options.h): visitors
// that read, write and describe (scene_schema.cpp) numbers, texts, file names, points, rotations,
// nested structs and lists. "rad" fields stand in degrees under a key that ends in _deg.
#pragma once

#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "simulation/core/options.h"
#include "simulation/core/units.h"
#include "simulation/scene/json/json_object_reader.h"
#include "simulation/scene/limits/scene_limits.h"

namespace arthro {
namespace internal {

template <class T>
inline constexpr bool kIsPoint = std::is_same_v<T, glm::dvec2> || std::is_same_v<T, glm::dvec3>;

// A point, or one that may be missing.
template <class T>
inline constexpr bool kIsMaybePoint = kIsPoint<T>;
template <class T>
inline constexpr bool kIsMaybePoint<std::optional<T>> = kIsPoint<T>;

template <class T>
struct IsVariant : std::false_type {};
template <class... Kinds>
struct IsVariant<std::variant<Kinds...>> : std::true_type {};

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

// Key that tells the structs of a variant apart.
template <class Kind>
constexpr const char* KindKey() {
  if constexpr (requires { Kind::kKindKey; })
    return Kind::kKindKey;
  else
    return "type";
}

// Accepts the key of every field without reading it.
struct KeyVisitor {
  JsonObjectReader& reader;
  template <class T, class Rule>
  void operator()(const char* name, T&, const Rule&, const char* unit, const char*) {
    reader.Know(name + std::string(FileBorder(unit).suffix));
  }
};

}  // namespace internal

// Unit of a field as messages and the schema name it.
const char* UnitInFile(std::string_view unit);
// Range of a field in the unit of the file, without the rounding error of a conversion.
JsonLimits LimitsInFile(const Range& range, const char* unit);
// The shortest degrees that are read back as exactly these radians: 30, not 29.999999999999996.
double FileDegrees(double radians);

class FieldReader {
 public:
  // `names`: those that the elements of this list have taken; null outside of a list.
  explicit FieldReader(JsonObjectReader& reader, std::set<std::string>* names = nullptr)
      : reader_(reader), names_(names) {}

  template <class T, class Rule>
  void operator()(const char* name, T& field, const Rule& rule, const char* unit, const char*) {
    Read(name, field, rule, unit, JsonObjectReader::kOptional);
  }

 private:
  using Need = JsonObjectReader::Need;

  template <class T, class Rule>
  void Read(const char* name, T& field, const Required<Rule>& rule, const char* unit, Need) {
    Read(name, field, rule.rule, unit, JsonObjectReader::kRequired);
  }
  template <class T, class Rule>
  void Read(const char* name, T& field, const Always<Rule>& rule, const char* unit, Need need) {
    Read(name, field, rule.rule, unit, need);
  }
  template <class T, class V, class Rule>
  void Read(const char* name, T& field, const LeftOutAt<V, Rule>& rule, const char* unit,
            Need need) {
    Read(name, field, rule.rule, unit, need);
  }
  // While the choice itself is at fault nobody knows what belongs to it.
  template <class T, class Rule>
  void Read(const char* name, T& field, const OnlyIf<Required<Rule>>& rule, const char* unit,
            Need) {
    if (!is_choice_known_)
      Read(name, field, rule.rule.rule, unit, JsonObjectReader::kOptional);
    else if (rule.holds)
      Read(name, field, rule.rule, unit, JsonObjectReader::kRequired);
  }

  template <class T, class Rule>
  void Read(const char* name, T& field, const Rule& rule, const char* unit, Need need) {
    if constexpr (std::is_same_v<T, double>) {
      const std::string key = name + std::string(FileBorder(unit).suffix);
      const JsonLimits limits = LimitsInFile(rule, unit);
      if (std::string_view(unit) == "rad")
        reader_.Angle(key.c_str(), field, limits);
      else
        reader_.Number(name, field, limits, need);
    } else if constexpr (std::is_same_v<T, std::optional<double>>) {
      double value = std::numeric_limits<double>::quiet_NaN();
      Read(name, value, rule, unit, need);
      if (!std::isnan(value)) field = value;
    } else if constexpr (std::is_same_v<T, int>) {
      reader_.Whole(name, field, LimitsInFile(rule, unit), need);
    } else if constexpr (std::is_same_v<T, bool>) {
      reader_.Flag(name, field);
    } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
      reader_.Path(name, field, need);
    } else if constexpr (std::is_same_v<T, std::string>) {
      ReadText(name, field, rule, need);
    } else if constexpr (std::is_enum_v<T>) {
      ReadChoice(name, field, rule, need);
    } else if constexpr (internal::kIsMaybePoint<T>) {
      ReadPoint(name, field, rule, unit, need);
    } else if constexpr (std::is_same_v<T, glm::dquat>) {
      reader_.Quaternion(name, field);
    } else if constexpr (std::is_same_v<T, std::vector<glm::dvec3>>) {
      reader_.Points(name, field, rule.least, rule.most, LimitsInFile(rule.each, unit));
    } else if constexpr (std::is_same_v<Rule, NumberList>) {
      ReadNumbers(name, field, unit);
    } else if constexpr (std::is_same_v<Rule, TextList>) {
      reader_.Texts(name, field);
    } else if constexpr (requires { field.emplace_back(); }) {
      ReadList(name, field);
    } else if constexpr (internal::IsOptional<T>::value) {
      reader_.Object(name, need,
                     [&](JsonObjectReader& inner) { field.emplace().Visit(FieldReader(inner)); });
    } else {
      reader_.Object(name, need, [&](JsonObjectReader& inner) { field.Visit(FieldReader(inner)); });
    }
  }

  void ReadText(const char* name, std::string& field, const Any&, Need need) {
    reader_.Text(name, field, need);
  }
  void ReadText(const char* name, std::string& field, const Words& rule, Need need);
  void ReadText(const char* name, std::string& field, const Name& rule, Need);

  template <class E>
  void ReadChoice(const char* name, E& field, const Choices<E>& rule, Need need) {
    std::string word;
    reader_.Text(name, word, need);
    // A choice that may be left out keeps its default.
    is_choice_known_ = need == JsonObjectReader::kOptional && !reader_.Has(name);
    std::vector<const char*> words;
    for (const auto& [value, its_word] : rule.words) {
      words.push_back(its_word);
      if (word != its_word) continue;
      field = value;
      is_choice_known_ = true;
    }
    if (!is_choice_known_ && !word.empty()) FaultOfWord(name, word, words);
  }

  template <class T>
  void ReadPoint(const char* name, T& field, const Range& rule, const char* unit, Need need) {
    const std::string key = name + std::string(FileBorder(unit).suffix);
    T value = field;
    value[0] = std::numeric_limits<double>::quiet_NaN();
    reader_.Point(key.c_str(), value, LimitsInFile(rule, unit), need);
    if (std::isnan(value[0])) return;  // absent or at fault
    for (int i = 0; i < T::length(); ++i)
      field[i] = FileBorder(unit).factor == 1.0 ? value[i] : value[i] / FileBorder(unit).factor;
  }
  template <class T>
  void ReadPoint(const char* name, std::optional<T>& field, const Range& rule, const char* unit,
                 Need need) {
    T value(std::numeric_limits<double>::quiet_NaN());
    ReadPoint(name, value, rule, unit, need);
    if (!std::isnan(value[0])) field = value;
  }
  void ReadPoint(const char* name, glm::dvec3& field, const Direction& rule, const char* unit,
                 Need need);
  void ReadNumbers(const char* name, std::vector<double>& field, const char* unit);

  template <class T>
  void ReadList(const char* name, std::vector<T>& list) {
    std::set<std::string> names;
    reader_.Array(name, [&](JsonObjectReader& inner, int) {
      if constexpr (internal::IsVariant<T>::value)
        ReadKind(inner, list, names);
      else
        list.emplace_back().Visit(FieldReader(inner, &names));
    });
  }

  // An element that is one of several structs, told apart by "type" or their own key.
  template <class... Kinds>
  static void ReadKind(JsonObjectReader& reader, std::vector<std::variant<Kinds...>>& list,
                       std::set<std::string>& names) {
    constexpr const char* kKey = internal::KindKey<std::tuple_element_t<0, std::tuple<Kinds...>>>();
    std::string type;
    reader.Text(kKey, type, JsonObjectReader::kRequired);
    bool is_known = false;
    const auto try_kind = [&]<class Kind>(Kind kind) {
      if (type != Kind::kType) return;
      is_known = true;
      std::get<Kind>(list.emplace_back(std::move(kind))).Visit(FieldReader(reader, &names));
    };
    (try_kind(Kinds{}), ...);
    if (is_known) return;
    if (!type.empty()) FieldReader(reader).FaultOfWord(kKey, type, {Kinds::kType...});
    // Accepts the keys of all kinds, so that one fault is not reported as several.
    const auto know = [&]<class Kind>(Kind kind) { kind.Visit(internal::KeyVisitor{reader}); };
    (know(Kinds{}), ...);
  }

  void FaultOfWord(const char* name, const std::string& word,
                   const std::vector<const char*>& words);

  JsonObjectReader& reader_;
  std::set<std::string>* names_;
  bool is_choice_known_ = true;
};

class FieldWriter {
 public:
  explicit FieldWriter(nlohmann::ordered_json& json) : json_(json) {}

  template <class T, class Rule>
  void operator()(const char* name, T& field, const Rule& rule, const char* unit, const char*) {
    Write(name, field, rule, unit, false);
  }

 private:
  using Json = nlohmann::ordered_json;

  template <class T, class Rule>
  void Write(const char* name, T& field, const Required<Rule>& rule, const char* unit, bool) {
    Write(name, field, rule.rule, unit, true);
  }
  template <class T, class Rule>
  void Write(const char* name, T& field, const Always<Rule>& rule, const char* unit, bool) {
    Write(name, field, rule.rule, unit, true);
  }
  template <class T, class V, class Rule>
  void Write(const char* name, T& field, const LeftOutAt<V, Rule>& rule, const char* unit,
             bool always) {
    if (field != rule.value) Write(name, field, rule.rule, unit, always);
  }
  template <class T, class Rule>
  void Write(const char* name, T& field, const OnlyIf<Rule>& rule, const char* unit, bool always) {
    if (rule.holds) Write(name, field, rule.rule, unit, always);
  }

  // Texts, lists and structs that are empty are left out unless `always`.
  template <class T, class Rule>
  void Write(const char* name, T& field, const Rule& rule, const char* unit, bool always) {
    if constexpr (std::is_same_v<T, double>) {
      const bool is_angle = std::string_view(unit) == "rad";
      json_[name + std::string(FileBorder(unit).suffix)] = is_angle ? FileDegrees(field) : field;
    } else if constexpr (std::is_same_v<T, std::optional<double>>) {
      if (field) Write(name, *field, rule, unit, always);
    } else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, int>) {
      json_[name] = field;
    } else if constexpr (std::is_same_v<Rule, NumberList>) {
      WriteNumbers(name, field, unit);
    } else if constexpr (std::is_same_v<Rule, TextList>) {
      if (always || !field.empty()) json_[name] = field;
    } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
      if (always || !field.empty()) json_[name] = field.generic_string();
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (always || std::is_same_v<Rule, Name> || !field.empty()) json_[name] = field;
    } else if constexpr (std::is_enum_v<T>) {
      for (const auto& [value, word] : rule.words)
        if (value == field) json_[name] = word;
    } else if constexpr (internal::kIsPoint<T>) {
      json_[name + std::string(FileBorder(unit).suffix)] = JsonFromPoint(field, unit);
    } else if constexpr (std::is_same_v<T, glm::dquat>) {
      json_[name] = {field.w, field.x, field.y, field.z};
    } else if constexpr (std::is_same_v<T, std::vector<glm::dvec3>>) {
      json_[name] = Json::array();
      for (const glm::dvec3& point : field) json_[name].push_back(JsonFromPoint(point, unit));
    } else if constexpr (internal::IsOptional<T>::value) {
      if (field) Write(name, *field, rule, unit, true);
    } else if constexpr (requires { field.emplace_back(); }) {
      for (auto& element : field) json_[name].push_back(JsonFromElement(element));
    } else if constexpr (internal::IsOptional<T>::value) {
      if (field) json_[name] = JsonFromElement(*field);
    } else {
      Json own = Json::object();
      field.Visit(FieldWriter(own));
      if (!own.empty()) json_[name] = std::move(own);
    }
  }

  // Angles stand in degrees; an empty list of them is left out.
  void WriteNumbers(const char* name, const std::vector<double>& field, const char* unit);

  template <class T>
  static Json JsonFromElement(T& element) {
    Json json = Json::object();
    if constexpr (internal::IsVariant<T>::value)
      std::visit(
          [&](auto& kind) {
            json[internal::KindKey<std::decay_t<decltype(kind)>>()] = kind.kType;
            kind.Visit(FieldWriter(json));
          },
          element);
    else
      element.Visit(FieldWriter(json));
    return json;
  }

  template <class V>
  static Json JsonFromPoint(const V& point, const char* unit) {
    const bool is_angle = std::string_view(unit) == "rad";
    Json json = Json::array();
    for (int i = 0; i < V::length(); ++i)
      json.push_back(is_angle ? FileDegrees(point[i]) : point[i]);
    return json;
  }

  Json& json_;
};

}  // namespace arthro
