// Every key of scene.json, version 1 [method.md, Scene] (resources/schemas/scene-1.schema.json says
// the same to other tools). Lengths in m, angles in rad in memory and in degrees under keys that
// end in _deg.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "simulation/scene/json_object_reader.h"
#include "simulation/scene/scene.h"

namespace arthro {

// Reads a file of the newest version (scene_migration.h). Every fault is added to `faults`; what
// they name keeps its default.
Scene SceneFromJson(const nlohmann::json& json, std::vector<JsonFault>& faults);

// Every field, in the order in which a person would tell it; parts that the scene lacks are left
// out.
nlohmann::ordered_json JsonFromScene(const Scene& scene);

// As a person would write it: two spaces a level, short lists on one line.
std::string PrettyJson(const nlohmann::ordered_json& json);

}  // namespace arthro
