#include "simulation/scene/json/scene_json.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "simulation/core/json_text.h"
#include "simulation/scene/json/field_json.h"
#include "simulation/scene/json/scene_migration.h"

namespace arthro {
namespace {

using nlohmann::ordered_json;

// A file may repeat the length of the scope's rod in its rig; both must agree. Removes the copy.
struct RepeatedRod {
  explicit RepeatedRod(nlohmann::json& scene) {
    const auto rig = scene.find("rig");
    if (rig == scene.end() || !rig->is_object()) return;
    const auto scope = rig->find("scope");
    if (scope == rig->end() || !scope->is_object() || !scope->contains("rod_length")) return;
    length = (*scope)["rod_length"];
    scope->erase("rod_length");
  }
  void Check(double rod_length, std::vector<JsonFault>& faults) const {
    if (length.is_discarded() || (length.is_number() && length == rod_length)) return;
    faults.push_back({"rig.scope.rod_length",
                      fmt::format("rig.scope.rod_length is {} but scope.rod_length is {}; keep one "
                                  "of them",
                                  length.dump(), rod_length)});
  }
  nlohmann::json length = nlohmann::json::value_t::discarded;
};

void Print(const ordered_json& json, std::size_t indent, std::string& text) {
  const bool is_short_list =
      json.is_array() && std::none_of(json.begin(), json.end(),
                                      [](const auto& element) { return element.is_structured(); });
  if (json.empty() || !json.is_structured()) {
    text += json.dump();
    return;
  }
  text += json.is_array() ? '[' : '{';
  bool is_first = true;
  for (const auto& [key, value] : json.items()) {
    if (!is_first) text += is_short_list ? ", " : ",";
    is_first = false;
    if (!is_short_list) text += '\n' + std::string(indent + 2, ' ');
    if (json.is_object()) text += ordered_json(key).dump() + ": ";
    Print(value, indent + 2, text);
  }
  if (!is_short_list) text += '\n' + std::string(indent, ' ');
  text += json.is_array() ? ']' : '}';
}

}  // namespace

Scene SceneFromJson(nlohmann::json json, std::vector<JsonFault>& faults) {
  Scene scene;
  const RepeatedRod rod(json);
  JsonObjectReader reader(json, "", faults);
  std::string schema;
  reader.Text("schema", schema);
  scene.Visit(FieldReader(reader));
  reader.RefuseOtherKeys(true);
  rod.Check(scene.rig.scope.rod_length, faults);
  const Backdrop& backdrop = scene.backdrop;
  for (const auto& [name, file] : {std::pair{"depth_sigma", &backdrop.depth_sigma},
                                   std::pair{"depth_origin", &backdrop.depth_origin}})
    if (!file->empty() && !json["backdrop"].contains("depth")) {
      const std::string key = fmt::format("backdrop.{}", name);
      faults.push_back({key, key + " is given without backdrop.depth, which it describes; name the "
                                   "depth map too or leave it out"});
    }
  for (std::size_t i = 0; i < scene.tissues.size(); ++i)
    if (scene.tissues[i].is_implicit && !scene.tissues[i].mesh.empty()) {
      const std::string key = fmt::format("tissues[{}].implicit", i);
      faults.push_back(
          {key, key + " is true of a tissue that has a mesh; leave out one of the two"});
    }
  for (const auto& [key, value] : json.items())
    if (key.starts_with("x-")) scene.extensions[key] = value.dump();
  return scene;
}

ordered_json JsonFromScene(Scene scene) {
  ordered_json json;
  json["schema"] = SceneSchemaName(kSceneVersion);
  scene.Visit(FieldWriter(json));
  for (const auto& [key, text] : scene.extensions)
    json[key] = ParseOrderedJson(text, Code::kBadScene);
  return json;
}

std::string PrettyJson(const ordered_json& json) {
  std::string text;
  Print(json, 0, text);
  return text + "\n";
}

}  // namespace arthro
