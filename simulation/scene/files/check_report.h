// Findings of a check of a scene as JSON, by resources/schemas/check-1.schema.json.
#pragma once

#include <string>

#include "simulation/scene/files/scene_check.h"

namespace arthro {

std::string JsonFromFindings(const SceneFindings& findings);

}  // namespace arthro
