// A scene.json that uses every key, for tests that change one thing at a time.
#pragma once

#include <vector>

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
      "depth_sigma": "sigma.tiff",
      "depth_origin": "origin.png",
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
       "material": "meniscus", "colour": [0.9, 0.8, 0.7], "cuttable": false,
       "elasticity": {"young_modulus": 4e5, "poisson_ratio": 0.4, "density": 1050, "fibre_stiffness": 1e7,
                      "fibre_axis": "circumferential_z", "layer_thickness": 0.002},
       "fixed": [{"centre": [0.01, 0, 0.002], "radius": 0.003}, {"centre": [0, -0.01, 0], "radius": 0.002}],
       "probed": [{"centre": [0, 0.01, 0.001], "radius": 0.0015}],
       "cuts": [{"type": "tear", "path": [[0, 0, 0.002], [0.003, 0.001, 0.002], [0.006, 0, 0.002]], "into": [0, 0.1, -1],
                 "depth": 0.003, "width": 0.0006, "lead": 0.0015},
                {"type": "capsule", "a": [0.01, 0, 0], "b": [0.01, 0.002, 0], "radius": 0.0015},
                {"type": "box", "centre": [0, 0.01, 0], "quaternion": [0, 0, 0, 1], "half": [0.002, 0.001, 0.001]}],
       "regions": [{"name": "anterior horn", "centre": [0, 0.01, 0], "radius": 0.005},
                   {"name": "posterior horn", "centre": [0, -0.01, 0], "radius": 0.006}],
       "rights": {"source": "scan", "licence": "CC-BY-4.0", "consent": "given in writing"}},
      {"name": "plateau", "surface": "plateau.ply", "implicit": true}
    ],
    "instruments": [{"name": "probe", "kind": "probe"}, {"name": "punch", "kind": "punch"}],
    "tasks": [{"id": "look", "title": "Look round", "text": "Find the posterior horn."}],
    "x-course": {"week": 3}
  })");
}

struct SceneFault {
  const char* pointer;  // place of the change
  nlohmann::json value;
  const char* key;             // name of the place in the reader's sentence
  const char* says;            // part of its sentence
  bool schema_sees_it = true;  // false for rules that JSON Schema cannot express
};

// One fault each, for the reader and for the JSON Schema.
inline std::vector<SceneFault> SceneFaults() {
  return {
      {"/backdrop/radius", -0.05, "backdrop.radius", "more than 0"},
      {"/backdrop/radius", 0, "backdrop.radius", "more than 0"},
      {"/backdrop/radius", 50, "backdrop.radius", "metres"},
      {"/backdrop/radius", "0.05", "backdrop.radius", "\"0.05\""},
      {"/backdrop/radius", nullptr, "backdrop.radius", "null"},
      {"/backdrop/panorama", "", "backdrop.panorama", "empty"},
      {"/backdrop/panorama", "../../etc/passwd", "backdrop.panorama", "inside the scene's folder"},
      {"/backdrop/panorama", "a/../../b.png", "backdrop.panorama", "inside the scene's folder"},
      {"/backdrop/panorama", "/etc/passwd", "backdrop.panorama", "inside the scene's folder"},
      {"/backdrop/panorama", "C:\\p.png", "backdrop.panorama", "inside the scene's folder"},
      {"/backdrop/panorama", "folder/", "backdrop.panorama", "must name a file"},
      {"/backdrop/panorama", "..", "backdrop.panorama", "inside the scene's folder"},
      {"/backdrop/panorama", "a/.", "backdrop.panorama", "must name a file"},
      {"/backdrop/panorama", "a\nb.png", "backdrop.panorama", "inside the scene's folder"},
      {"/backdrop/depth", 7, "backdrop.depth", "name of a file"},
      {"/backdrop/depth_sigma", 0.001, "backdrop.depth_sigma", "name of a file"},
      {"/backdrop/depth_origin", "../o.png", "backdrop.depth_origin", "inside the scene's folder"},
      {"/backdrop/projection/type", "cylindrical", "backdrop.projection.type", "equirectangular"},
      {"/backdrop/projection/focal_px", 0, "backdrop.projection.focal_px", "more than 0"},
      {"/backdrop/projection/focal_px", false, "backdrop.projection.focal_px", "false"},
      {"/backdrop/projection/centre_px", {1}, "backdrop.projection.centre_px", "2 numbers"},
      {"/backdrop/projection/centre_px", {1, "2"}, "backdrop.projection.centre_px", "2 numbers"},
      {"/backdrop/projection", 5, "backdrop.projection", "object"},
      {"/scope/view_angle_deg", 170, "scope.view_angle_deg", "120 degrees"},
      {"/scope/field_of_view_deg", 0, "scope.field_of_view_deg", "more than 0"},
      {"/scope/rod_length", 200, "scope.rod_length", "metres"},
      {"/scope/lens", "../lens.json", "scope.lens", "inside the scene's folder"},
      {"/portals/incision_spacing", 30, "portals.incision_spacing", "metres"},
      {"/rig/scope/portal_from_device",
       {0, 0, 0, 0},
       "rig.scope.portal_from_device",
       "[1, 0, 0, 0]"},
      {"/rig/scope/rod_length", 0.3, "rig.scope.rod_length", "scope.rod_length is 0.25", false},
      {"/rig/instrument/pivot", {0, 0}, "rig.instrument.pivot", "3 numbers"},
      {"/tissues/0/pose/quaternion", {0, 0, 0, 0}, "tissues[0].pose.quaternion", "all zeros"},
      {"/tissues/0/pose/scale", 0, "tissues[0].pose.scale", "more than 0"},
      {"/tissues/0/colour", {0.5, 0.5, 1.5}, "tissues[0].colour", "between 0 and 1"},
      {"/tissues/0/elasticity/young_modulus", 0, "tissues[0].elasticity.young_modulus", "pascals"},
      {"/tissues/0/elasticity/young_modulus",
       nullptr,  // NaN is written as null
       "tissues[0].elasticity.young_modulus", "null"},
      {"/tissues/0/elasticity/poisson_ratio", 0.5, "tissues[0].elasticity.poisson_ratio",
       "between -0.9 and 0.49999"},
      {"/tissues/0/elasticity/density", -1100, "tissues[0].elasticity.density", "kg/m³"},
      {"/tissues/0/elasticity/fibre_stiffness", -1, "tissues[0].elasticity.fibre_stiffness",
       "between 0"},
      {"/tissues/0/elasticity/fibre_axis", "radial", "tissues[0].elasticity.fibre_axis",
       "none, circumferential_z"},
      {"/tissues/0/elasticity/layer_thickness", 2.5, "tissues[0].elasticity.layer_thickness",
       "metres"},
      {"/tissues/0/elasticity/youngs_modulus", 4e5, "tissues[0].elasticity.youngs_modulus",
       "did you mean \"young_modulus\"?"},
      {"/tissues/0/fixed/0/radius", 0, "tissues[0].fixed[0].radius", "more than 0"},
      {"/tissues/0/fixed/1/radius", nullptr, "tissues[0].fixed[1].radius", "null"},
      {"/tissues/0/fixed/1/centre", {0, nullptr, 0}, "tissues[0].fixed[1].centre", "3 numbers"},
      {"/tissues/0/fixed/1", {0, 0, 0}, "tissues[0].fixed[1]", "object"},
      {"/tissues/0/probed/0/radius", -0.001, "tissues[0].probed[0].radius", "more than 0"},
      {"/tissues/0/probed/0/centre", {0, 0, "far"}, "tissues[0].probed[0].centre", "3 numbers"},
      {"/tissues/0/probed", 3, "tissues[0].probed", "list"},
      {"/tissues/0/cuts/0/type", "slash", "tissues[0].cuts[0].type", "capsule, box, tear"},
      {"/tissues/0/cuts/0/path", nlohmann::json::array(), "tissues[0].cuts[0].path",
       "2 to 1000 points"},
      {"/tissues/0/cuts/0/path", {{0, 0, 0}}, "tissues[0].cuts[0].path", "2 to 1000 points"},
      {"/tissues/0/cuts/0/path/1", {0, 0}, "tissues[0].cuts[0].path", "points [x, y, z]"},
      {"/tissues/0/cuts/0/path/1/0", nullptr,  // NaN is written as null
       "tissues[0].cuts[0].path", "null"},
      {"/tissues/0/cuts/0/path/1/0", 3, "tissues[0].cuts[0].path", "metres"},
      {"/tissues/0/cuts/0/into", {0, 0, 0}, "tissues[0].cuts[0].into", "all zeros"},
      {"/tissues/0/cuts/0/depth", 0, "tissues[0].cuts[0].depth", "more than 0"},
      {"/tissues/0/cuts/0/width", -1e-3, "tissues[0].cuts[0].width", "more than 0"},
      {"/tissues/0/cuts/0/lead", -1e-3, "tissues[0].cuts[0].lead", "between 0"},
      {"/tissues/0/cuts/0/radius", 1e-3, "tissues[0].cuts[0].radius", "not known"},
      {"/tissues/0/cuts/1/radius", nullptr, "tissues[0].cuts[1].radius", "null"},
      {"/tissues/0/cuts/1/a", {0, "0", 0}, "tissues[0].cuts[1].a", "3 numbers"},
      {"/tissues/0/cuts/2/half", {1e-3, 0, 1e-3}, "tissues[0].cuts[2].half", "more than 0"},
      {"/tissues/0/cuts/2/quaternion", {0, 0, 0, 0}, "tissues[0].cuts[2].quaternion", "all zeros"},
      {"/tissues/0/cuts/1", 7, "tissues[0].cuts[1]", "object"},
      {"/tissues/0/cuts", "tear", "tissues[0].cuts", "list"},
      {"/tissues/0/regions/0/name", "", "tissues[0].regions[0].name", "empty"},
      {"/tissues/0/regions/0/name", "elsewhere", "tissues[0].regions[0].name", "choose another"},
      {"/tissues/0/regions/1/name", "anterior horn", "tissues[0].regions[1].name", "used twice",
       false},
      {"/tissues/0/regions/0/radius", 0, "tissues[0].regions[0].radius", "more than 0"},
      {"/tissues/0/cuttable", "no", "tissues[0].cuttable", "true or false"},
      {"/tissues/1/implicit", 1, "tissues[1].implicit", "true or false"},
      {"/instruments/0/kind", "scalpel", "instruments[0].kind", "probe, punch, shaver, grasper"},
      {"/tissues/1/name", "", "tissues[1].name", "empty"},
      {"/tissues/1/name", "backdrop", "tissues[1].name", "choose another"},
      {"/tissues/1/name", "a,b", "tissues[1].name", "comma"},
      {"/tissues/1/name", "medial meniscus", "tissues[1].name", "used twice", false},
      {"/tissues/1/surface", "~/../x.ply", "tissues[1].surface", "inside the scene's folder"},
      {"/tissues/1", 3, "tissues[1]", "object"},
      {"/tissues", "none", "tissues", "list"},
      {"/tasks/0/id", 1, "tasks[0].id", "text"},
      {"/instruments/0/name", nullptr, "instruments[0].name", "text"},
      {"/backdrop/raduis", 0.05, "backdrop.raduis", "did you mean \"radius\"?"},
      {"/backdrop/projection/focal", 5, "backdrop.projection.focal", "did you mean \"focal_px\"?"},
      {"/backdrop/projection/center_px",
       {1, 2},
       "backdrop.projection.center_px",
       "did you mean \"centre_px\"?"},
      {"/tissues/0/color", {1, 1, 1}, "tissues[0].color", "did you mean \"colour\"?"},
      {"/titel", "x", "titel", "did you mean \"title\"?"},
      {"/something", 1, "something", "\"x-\""},
      {"/scope/x-own", 1, "scope.x-own", "not known"}};
}

}  // namespace arthro::test
