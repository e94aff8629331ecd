// The scene: all that a practice session needs, as plain values (design §6). Lengths in metres,
// angles in radians, positions in the portal frame unless a name says otherwise. Paths are relative
// to the scene's folder. Read, written and checked by scene_io.h; nothing here touches a file.
#pragma once

#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/frames.h"
#include "simulation/scene/projection.h"

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
};

struct Rig {
  DeviceRig scope, instrument;
};

struct Tissue {
  std::string name;
  std::filesystem::path surface;        // closed surface, in the tissue's own frame
  std::filesystem::path mesh;           // VTU; empty until it is tetrahedralised
  Pose pose;                            // portal_from_tissue
  std::string material = "meniscus";    // preset name
  glm::dvec3 colour{0.93, 0.90, 0.84};  // linear RGB
  AssetRights rights;
};

struct Instrument {
  std::string name = "probe";
  std::string kind = "probe";
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
