// Scenes from and to the JSON of scene.json, version 2 [method.md, Scene], by the list of fields in
// scene.h. Lengths in m; angles in rad in memory and in degrees under keys that end in _deg.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "simulation/scene/json/json_object_reader.h"
#include "simulation/scene/scene.h"

namespace arthro {

// Reads a file of the newest version (scene_migration.h). Appends every fault to `faults`; a field
// at fault keeps its default.
Scene SceneFromJson(nlohmann::json json, std::vector<JsonFault>& faults);

// Every field in the order of scene.h; parts that the scene lacks are left out.
nlohmann::ordered_json JsonFromScene(Scene scene);

// Text with two spaces per level and short lists on one line.
std::string PrettyJson(const nlohmann::ordered_json& json);

}  // namespace arthro
