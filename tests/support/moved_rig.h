// A rig file of one scope hand whose incision lies aside and turned, with a key of somebody else's
// that has to outlive a rewriting of the file.
#pragma once

#include <glm/vec3.hpp>

namespace arthro::test {

constexpr const char* kMovedRig = R"({"schema": "arthroscene.rig/1", "title": "t", "x-room": "3.14",
  "scope": {"device": {"family": "razer_hydra"}, "rod_length": 0.25,
            "pivot": [0.02, -0.01, 0.1], "portal_from_device": [0.5, 0.5, 0.5, -0.5]}})";
const glm::dvec3 kMovedPivot(0.02, -0.01, 0.1);  // m, as in the file

}  // namespace arthro::test
