#include "simulation/scene/json/scene_schema.h"

#include <fmt/format.h>

#include "simulation/scene/json/field_schema.h"
#include "simulation/scene/json/scene_json.h"
#include "simulation/scene/json/scene_migration.h"
#include "simulation/scene/scene.h"

namespace arthro {

std::string SceneSchemaText() {
  nlohmann::ordered_json json = FileSchema(
      SceneSchemaName(kSceneVersion), fmt::format("Arthroscene scene, version {}", kSceneVersion),
      "scene.json of a scene folder. Lengths in metres; angles in degrees under keys that end in "
      "_deg. Directions and positions in the portal frame: origin at the scope portal, +z into the "
      "joint, +x to the viewer's right, +y down. This schema cannot express that names of tissues, "
      "names of regions in a tissue, ids of exercises, and ids of targets and steps in an exercise "
      "are unique.",
      SchemaOfFields(Scene()));
  // Older writers repeat the length of the scope's rod here.
  auto& rod = json["properties"]["rig"]["properties"]["scope"]["properties"]["rod_length"];
  rod = internal::Number(kLength, "m");
  rod["description"] = "If given, the same as scope.rod_length.";
  json["definitions"] = FieldDefinitions();
  return PrettyJson(json);
}

}  // namespace arthro
