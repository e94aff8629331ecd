// Scene: the values that a practice session needs [method.md, Scene]. Lengths in m, angles in rad,
// positions in the portal frame unless a name says otherwise. Paths are relative to the scene's
// folder. Each Visit lists the fields once, in the order of scene.json: name, rule, unit, help
// (simulation/core/options.h). Reader, writer, schema, flags and panels use that list.
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
#include "simulation/core/options.h"
#include "simulation/scene/elasticity.h"
#include "simulation/scene/exercise/exercise.h"
#include "simulation/scene/limits/scene_limits.h"
#include "simulation/scene/projection.h"
#include "simulation/scene/tissue_parts.h"

namespace arthro {

// Origin of an asset, its licence, and the consent to its use.
struct AssetRights {
  std::string source, licence, consent;
  friend bool operator==(const AssetRights&, const AssetRights&) = default;
  template <class V>
  void Visit(V&& v) {
    v("source", source, Any{}, "", "Who made it, or where it comes from.");
    v("licence", licence, Any{}, "", "Licence under which it may be used.");
    v("consent", consent, Any{}, "", "Consent of the patient.");
  }
};

// Side of the body. The mirror image of a right knee is a left one.
enum class BodySide { kUnknown, kLeft, kRight };

// Filling of the joint. It decides how much light a wet surface mirrors
// (simulation/scene/medium.h).
enum class Medium { kSaline, kGas };

struct Backdrop {
  std::filesystem::path panorama, depth;  // no depth: a bare sphere
  std::filesystem::path depth_sigma, depth_origin;
  std::filesystem::path footage;  // how the panorama was made; empty: not known
  double radius = 0.05;           // D, of the sphere about the scope portal
  Projection projection;
  AssetRights rights, depth_rights;
  double relight = 0;
  Medium medium = Medium::kSaline;
  friend bool operator==(const Backdrop&, const Backdrop&) = default;
  template <class V>
  void Visit(V&& v) {
    v("panorama", panorama, Required{Any{}}, "", "8-bit colour picture.");
    v("depth", depth, Any{}, "",
      "One-channel 32-bit float TIFF of the panorama's size: relief over the sphere towards the "
      "portal, in metres; NaN where nothing was imaged.");
    v("depth_sigma", depth_sigma, Any{}, "",
      "One-channel 32-bit float TIFF of the depth map's size: standard error of the relief, in "
      "metres; NaN where it is not known.");
    v("depth_origin", depth_origin, Any{}, "",
      "One-channel 8-bit PNG of the depth map's size: 0 no depth, 1 measured, 2 estimated from "
      "brightness, 3 interpolated.");
    v("radius", radius, kLength, "m", "Radius of the sphere about the scope portal.");
    v("relight", relight, LeftOutAt{0.0, kShare}, "",
      "0: as it was filmed, with its light. 1: that light is evened out, and the scope's own lamp "
      "lights what is near, with wet highlights.");
    v("medium", medium,
      LeftOutAt{Medium::kSaline,
                Choices<Medium>{{{Medium::kSaline, "saline"}, {Medium::kGas, "gas"}}}},
      "",
      "Filling of the joint: in gas a wet surface mirrors some 80 times more of the lamp than in "
      "saline.");
    v("projection", projection, Required{Any{}}, "", "Pixel of the panorama for a direction.");
    v("rights", rights, Any{}, "", "Rights in the panorama.");
    v("depth_rights", depth_rights, Any{}, "",
      "Rights in a depth map that was not made from the panorama.");
    v("footage", footage, Any{}, "",
      "JSON: the clips that the panorama was made from, the choice of their frames, and the report "
      "of each frame (footage-1.schema.json).");
  }
};

struct ScopeSpec {
  double view_angle = std::numbers::pi / 6;     // α
  double field_of_view = std::numbers::pi / 2;  // full
  std::filesystem::path lens;                   // empty: equisolid
  friend bool operator==(const ScopeSpec&, const ScopeSpec&) = default;
  // The file keeps the length of the scope's rod here; in memory the scope's rig has it.
  template <class V>
  void Visit(V&& v, double* rod_length = nullptr) {
    v("view_angle", view_angle, Range{0, RadiansFromDegrees(120)}, "rad",
      "Angle between the rod and the view.");
    v("field_of_view", field_of_view, Range{0, RadiansFromDegrees(180), true}, "rad",
      "Full angle of the round picture, from edge to edge.");
    if (rod_length != nullptr)
      v("rod_length", *rod_length, kLength, "m", "From the hand to the lens.");
    v("lens", lens, Any{}, "", "lens.json of the scope; equisolid if not given.");
  }
};

struct Portals {
  double incision_spacing = 0.03;  // instrument portal at (spacing, 0, 0)
  friend bool operator==(const Portals&, const Portals&) = default;
  template <class V>
  void Visit(V&& v) {
    v("incision_spacing", incision_spacing, kCoordinate, "m",
      "From the scope's portal to the instrument's; negative when the instrument enters on the "
      "left.");
  }
};

// Pose of a device's frame in its portal's frame, and the rod that is mounted on the device.
struct DeviceRig {
  glm::dvec3 pivot{0.0};                              // in the device frame
  glm::dquat portal_from_device{1.0, 0.0, 0.0, 0.0};  // w, x, y, z
  double rod_length = 0.2;                            // L, hand to tip
  friend bool operator==(const DeviceRig&, const DeviceRig&) = default;
  template <class V>
  void Visit(V&& v, bool has_rod = true) {
    v("pivot", pivot, kCoordinate, "m", "Incision in the device frame.");
    v("portal_from_device", portal_from_device, Any{}, "",
      "Rotation [w, x, y, z] from the device frame to the portal's.");
    if (has_rod) v("rod_length", rod_length, kLength, "m", "From the hand to the tip.");
  }
};

struct Rig {
  DeviceRig scope, instrument;
  friend bool operator==(const Rig&, const Rig&) = default;
};

// Parts of scene.json that lie otherwise in memory: the scope's rod length stands in "scope".
struct ScopeInFile {
  ScopeSpec& scope;
  double& rod_length;
  template <class V>
  void Visit(V&& v) {
    scope.Visit(v, &rod_length);
  }
};
struct MountInFile {
  DeviceRig& rig;
  template <class V>
  void Visit(V&& v) {
    rig.Visit(v, false);
  }
};
struct RigInFile {
  Rig& rig;
  template <class V>
  void Visit(V&& v) {
    MountInFile mount{rig.scope};
    v("scope", mount, Any{}, "", "Device of the scope.");
    v("instrument", rig.instrument, Any{}, "", "Device of the instrument.");
  }
};

// Contacts in forces.csv are told by these words or by a tissue's name [method.md, File formats].
inline constexpr const char* kContactWords[] = {"none", "backdrop"};

struct Tissue {
  // Compiled once, in scene.cpp, since most sources copy scenes.
  Tissue();
  Tissue(const Tissue&);
  Tissue(Tissue&&) noexcept;
  Tissue& operator=(const Tissue&);
  Tissue& operator=(Tissue&&) noexcept;
  ~Tissue();

  std::string name;
  std::filesystem::path surface;      // in the tissue's own frame
  std::filesystem::path mesh;         // empty: it does not deform as a volume
  Pose pose;                          // portal_from_tissue
  std::string material = "meniscus";  // name of a preset
  Elasticity elasticity;
  std::vector<Ball> fixed, probed;
  std::vector<Cut> cuts;
  std::vector<Region> regions;
  bool is_cuttable = true;
  bool is_implicit = false;
  glm::dvec3 colour{0.93, 0.90, 0.84};  // linear RGB
  AssetRights rights;
  friend bool operator==(const Tissue&, const Tissue&);
  template <class V>
  void Visit(V&& v) {
    v("name", name, Name{kContactWords, "force records use for something else", true}, "",
      "Name of the tissue.");
    v("surface", surface, Required{Any{}}, "",
      "Closed triangle surface, in metres, in the tissue's own frame.");
    v("mesh", mesh, Any{}, "", "VTU of its tetrahedra, in metres.");
    v("pose", pose, Any{}, "", "Portal from tissue: scale, then quaternion, then position.");
    v("material", material, Always{Any{}}, "", "Name of a preset.");
    v("elasticity", elasticity, Any{}, "", "Values that differ from the preset's.");
    v("fixed", fixed, Any{}, "",
      "Balls in the tissue's own frame that hold it: nodes inside do not move.");
    v("probed", probed, Any{}, "",
      "Balls in the tissue's own frame where it is touched most: its mesh is finer there.");
    v("cuts", cuts, Any{}, "",
      "Cuts of the author, in the tissue's own frame at rest; a session begins with these made.");
    v("regions", regions, Any{}, "",
      "Balls in the tissue's own frame. Removed volume is counted for the first that holds it.");
    v("cuttable", is_cuttable, LeftOutAt{true, Any{}}, "", "Whether instruments may cut it.");
    v("implicit", is_implicit, LeftOutAt{false, Any{}}, "",
      "Whether it is touched as a function sampled from its surface [paper, 3.4]; not together "
      "with a mesh.");
    v("colour", colour, kShare, "", "Linear red, green, blue.");
    v("rights", rights, Any{}, "", "Rights in the surface.");
  }
};

inline constexpr const char* kInstrumentKinds[] = {"probe", "punch", "shaver", "grasper"};

struct Instrument {
  std::string name = "probe";
  std::string kind = "probe";
  friend bool operator==(const Instrument&, const Instrument&) = default;
  template <class V>
  void Visit(V&& v) {
    v("name", name, Required{Any{}}, "", "Name of the instrument.");
    v("kind", kind, Words{kInstrumentKinds}, "", "Kind of the instrument.");
  }
};

struct Scene {
  // Compiled once, in scene.cpp, since most sources copy scenes.
  Scene();
  Scene(const Scene&);
  Scene(Scene&&) noexcept;
  Scene& operator=(const Scene&);
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  std::string title, author;
  BodySide side = BodySide::kUnknown;
  Backdrop backdrop;
  ScopeSpec scope;
  Portals portals;
  Rig rig;
  std::vector<Tissue> tissues;
  std::vector<Instrument> instruments;
  std::vector<Exercise> exercises;
  // Top-level keys of other tools: key ("x-…") to JSON text, saved unchanged.
  std::map<std::string, std::string> extensions;
  friend bool operator==(const Scene&, const Scene&);
  template <class V>
  void Visit(V&& v) {
    v("title", title, Any{}, "", "Title of the scene.");
    v("author", author, Any{}, "", "Author of the scene.");
    v("side", side,
      LeftOutAt{BodySide::kUnknown, Choices<BodySide>{{{BodySide::kUnknown, "unknown"},
                                                       {BodySide::kLeft, "left"},
                                                       {BodySide::kRight, "right"}}}},
      "", "Side of the body that the joint belongs to.");
    v("backdrop", backdrop, Required{Any{}}, "", "Panorama and its place.");
    ScopeInFile scope_in_file{scope, rig.scope.rod_length};
    v("scope", scope_in_file, Any{}, "", "Arthroscope.");
    v("portals", portals, Any{}, "", "Incisions.");
    RigInFile rig_in_file{rig};
    v("rig", rig_in_file, Any{}, "", "Mount of each device on its incision.");
    v("tissues", tissues, Any{}, "", "Tissues.");
    v("instruments", instruments, Any{}, "", "Instruments.");
    v("exercises", exercises, Any{}, "", "Exercises, in the order of the start page.");
  }
};

}  // namespace arthro
