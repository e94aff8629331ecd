// The scene: all that a practice session needs, as plain values [method.md, Scene]. Lengths in
// metres, angles in radians, positions in the portal frame unless a name says otherwise. Paths are
// relative to the scene's folder. Read, written and checked by scene_io.h; nothing here touches a
// file.
#pragma once

#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/frames.h"
#include "simulation/scene/projection.h"
#include "simulation/scene/tissue_parts.h"

namespace arthro {

// Who made an asset, under which licence, and by whose consent it may be used.
struct AssetRights {
  std::string source, licence, consent;
};

struct Backdrop {
  std::filesystem::path panorama;  // 8-bit colour
  std::filesystem::path depth;     // 32-bit float TIFF, same size; empty: a bare sphere
  double radius = 0.05;            // D, of the sphere about the scope portal
  Projection projection;
  AssetRights rights;
  // 0 to 1: how far the light of the footage is evened out and the scope's own put in its place.
  double relight = 0;
};

struct ScopeSpec {
  double view_angle = std::numbers::pi / 6;     // α
  double field_of_view = std::numbers::pi / 2;  // full
  double rod_length = 0.2;                      // L, hand to tip
  std::filesystem::path lens;                   // empty: equisolid
};

struct Portals {
  double incision_spacing = 0.03;  // instrument portal at (spacing, 0, 0); negative: on the left
};

// How one device's own frame lies in its portal's, and the rod that is mounted on it.
struct DeviceRig {
  glm::dvec3 pivot{0.0};                              // in the device frame
  glm::dquat portal_from_device{1.0, 0.0, 0.0, 0.0};  // w, x, y, z
  double rod_length = 0.2;                            // of the scope: as ScopeSpec::rod_length
  friend bool operator==(const DeviceRig&, const DeviceRig&) = default;
};

struct Rig {
  DeviceRig scope, instrument;
};

// What of a tissue's preset this scene says otherwise, under the names of CASE.json; SI.
struct Elasticity {
  std::optional<double> young_modulus;    // Pa
  std::optional<double> poisson_ratio;    // under 0.5
  std::optional<double> density;          // kg/m³
  std::optional<double> fibre_stiffness;  // Pa
  std::string fibre_axis;                 // "none", "circumferential_z"; empty: the preset's
  std::optional<double> layer_thickness;  // m, of a thin layer on bone
  friend bool operator==(const Elasticity&, const Elasticity&) = default;
};

struct Tissue {
  std::string name;
  std::filesystem::path surface;        // closed surface, in the tissue's own frame
  std::filesystem::path mesh;           // VTU; empty: it does not deform as a volume
  Pose pose;                            // portal_from_tissue
  std::string material = "meniscus";    // preset name
  Elasticity elasticity;                // where it differs from the preset
  std::vector<Ball> fixed;              // where it is held: what lies inside does not move
  std::vector<Ball> probed;             // where it is touched most: meshes are finer there
  std::vector<Cut> cuts;                // made before anybody touches it
  std::vector<Region> regions;          // of the first that holds it, what is taken is told
  bool is_cuttable = true;              // instruments may take of it
  bool is_implicit = false;             // touched as a sampled function [paper, 3.4]; no mesh then
  glm::dvec3 colour{0.93, 0.90, 0.84};  // linear RGB
  AssetRights rights;
};

struct Instrument {
  std::string name = "probe";
  std::string kind = "probe";  // "probe", "punch", "shaver" or "grasper"
};

struct Task {
  std::string id, title, text;
};

struct Scene {
  std::string title, author;
  Backdrop backdrop;
  ScopeSpec scope;
  Portals portals;
  Rig rig;
  std::vector<Tissue> tissues;
  std::vector<Instrument> instruments;
  std::vector<Task> tasks;
  // What other tools keep at the top of scene.json: key ("x-…") to JSON text, saved as it came.
  std::map<std::string, std::string> extensions;
};

}  // namespace arthro
