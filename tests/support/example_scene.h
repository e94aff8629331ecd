// A scene.json that uses every key, for tests that change one thing at a time.
#pragma once

#include <nlohmann/json.hpp>

namespace arthro::test {

inline nlohmann::json FullSceneJson() {
  return nlohmann::json::parse(R"({
    "schema": "arthroscene.scene/1",
    "title": "Medial meniscus, right knee",
    "author": "Dr. Ó Súilleabháin",
    "backdrop": {
      "panorama": "pictures/panorama.png",
      "depth": "depth.tiff",
      "radius": 0.045,
      "projection": {"type": "gnomonic", "centre_px": [31.5, 15.5], "focal_px": 40},
      "rights": {"source": "phantom", "licence": "CC0-1.0", "consent": "none needed: synthetic"}
    },
    "scope": {"view_angle_deg": 70, "field_of_view_deg": 105, "rod_length": 0.25, "lens": "lens.json"},
    "portals": {"incision_spacing": -0.028},
    "rig": {
      "scope": {"pivot": [0.01, 0.02, 0.15], "portal_from_device": [0, 1, 0, 0]},
      "instrument": {"rod_length": 0.18, "pivot": [0, 0, 0.1], "portal_from_device": [1, 0, 0, 0]}
    },
    "tissues": [
      {"name": "medial meniscus", "surface": "meniscus.ply", "mesh": "meniscus.vtu",
       "pose": {"position": [0.001, 0.002, 0.03], "quaternion": [0, 0, 1, 0], "scale": 1.25},
       "material": "meniscus", "colour": [0.9, 0.8, 0.7],
       "rights": {"source": "scan", "licence": "CC-BY-4.0", "consent": "given in writing"}},
      {"name": "plateau", "surface": "plateau.ply"}
    ],
    "instruments": [{"name": "probe", "kind": "probe"}, {"name": "punch", "kind": "punch"}],
    "tasks": [{"id": "look", "title": "Look round", "text": "Find the posterior horn."}],
    "x-course": {"week": 3}
  })");
}

}  // namespace arthro::test
