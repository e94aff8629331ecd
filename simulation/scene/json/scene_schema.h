// JSON Schema (draft 4) of scene.json, generated from the fields in scene.h. The copy for other
// tools is resources/schemas/scene-2.schema.json; `arthroscene check --schema` prints it.
#pragma once

#include <string>

namespace arthro {

std::string SceneSchemaText();

}  // namespace arthro
