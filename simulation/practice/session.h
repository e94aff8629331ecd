// A practice session: samples of two hands in, poses, contacts and forces out, one tick at a time
// [paper, 3.2, 3.4; method.md, Threads]. It draws nothing; a ServoLoop ticks it. Both tools take
// the same path: rod pose, contact of the tip, output chain. Portal frame, m, N, s.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "simulation/device/device_sample.h"
#include "simulation/haptics/output/output_chain.h"
#include "simulation/haptics/surface/surface_bvh.h"
#include "simulation/practice/field_surface.h"
#include "simulation/practice/session_options.h"
#include "simulation/practice/snapshot.h"
#include "simulation/practice/tissue_loop.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/tissue/body/tool_on_layers.h"
#include "simulation/tissue/contact/coupling.h"

namespace arthro::simulation {

class Session {
 public:
  // Without a depth map the bare sphere is touched where the panorama lies. A tissue without a
  // surface has no contact. An implicit tissue is sampled as a field and must be closed; throws
  // Error(kBadMesh). Copies what it needs from `loaded`.
  explicit Session(const LoadedScene& loaded, const SessionOptions& options = {});

  // Advances the session by dt. A sample whose t repeats ages by dt each tick; after max_sample_age
  // its device gets no force.
  void Tick(const DeviceSample& scope, const DeviceSample& instrument, double dt) noexcept;
  const Snapshot& snapshot() const noexcept { return snapshot_; }

  // The setters below are called between ticks, by the thread that ticks. After a move of its
  // portal the instrument enters anew.
  void SetIncisionSpacing(double spacing) noexcept;
  double incision_spacing() const noexcept { return spacing_; }
  void SetViewAngle(double view_angle) noexcept { view_angle_ = view_angle; }
  double view_angle() const noexcept { return view_angle_; }
  // Camera head and disturbances change the picture alone, and are part of what is recorded.
  void SetCameraHead(const CameraHead& head) noexcept { head_ = head; }
  const CameraHead& camera_head() const noexcept { return head_; }
  void SetDisturbances(const Disturbances& disturbances) noexcept { disturbances_ = disturbances; }
  const Disturbances& disturbances() const noexcept { return disturbances_; }
  // Applies contact, lever and limiter at once; options of the depth field need a new session.
  void SetOptions(const SessionOptions& options) noexcept { options_ = options; }
  const SessionOptions& options() const noexcept { return options_; }

  // Sets whether the hand may be pushed in the next ticks; default yes.
  void SetPush(DeviceRole role, HandPush push) noexcept {
    (role == DeviceRole::kScope ? scope_ : instrument_).push = push;
  }

  // Sets the least time in s for which a sample is fresh, for a device without force that reports
  // rarely.
  void SetFreshFor(DeviceRole role, double seconds) noexcept {
    (role == DeviceRole::kScope ? scope_ : instrument_).fresh_for = seconds;
  }

  // Makes these tissues deformable and removes them from the rigid surfaces. With
  // TissuePace::kInline the same inputs give the same bits. `layers` yield to both tools along
  // their whole length, in closed form within the servo tick; a layer with an open surface stays
  // rigid. Implicit tissues can then be cut by the instrument. Not on the servo path. Throws Error.
  void Enliven(std::vector<BodySpec> bodies, TissuePace pace, std::vector<LayerSpec> layers = {});
  // Moves the jaws and advances the clock of the tissue. Call after each Tick, on the same thread.
  // TissuePace::kInline steps the tissue here; kThread only hands over the tool.
  void TickTissues(double dt) noexcept;
  // Picture of the deformable tissues, for the one thread that draws; nullptr: there are none.
  const WorldPicture* tissues() noexcept { return tissues_ ? &tissues_->Read() : nullptr; }
  bool HasNewTissues() const noexcept { return tissues_ && tissues_->HasNew(); }
  void ResetTissues();  // restores all tissues; not on the servo path
  // Changes the instrument, between ticks. The new one enters anew and its force on tip and hand
  // rises from zero with the ramp of the limiter. No force of the old instrument, nor of a shape
  // that appears inside tissue, is given or recorded.
  void SetInstrument(ToolKind kind) noexcept;
  ToolKind instrument() const noexcept { return kind_; }

  // Sets one flag per tissue that is simulated as deformable (missing: 0); those are removed from
  // the rigid surfaces. Not on the servo path: it moves meshes.
  void SetLiveTissues(std::span<const std::uint8_t> is_live);
  // Replaces the mesh of a tissue by a field for contact; null restores the mesh. A cut is made in
  // a copy that is then set here. After Enliven, only for tissues that the scene does not declare
  // implicit. Not on the servo path.
  void SetField(int tissue, std::shared_ptr<const ImplicitTissue> field);
  // Sets the force of deformable tissue on the instrument. Call once per step of the tissue, also
  // while it rests, or the force fades. Repeating a step changes nothing. A faulty coupling gives
  // Fault::kTissue and no force until the next valid one.
  void SetCoupling(const ToolCoupling& coupling) noexcept;

  // Sets the mount of a hand's device after a calibration, between ticks. The tool changes place at
  // once, so it enters anew and its force ramps up.
  void SetMount(DeviceRole role, const DeviceRig& mount) noexcept;
  const DepthField& relief() const noexcept { return *field_; }
  const DeviceRig& scope_rig() const noexcept { return scope_.rig; }
  const DeviceRig& instrument_rig() const noexcept { return instrument_.rig; }

 private:
  struct Tool {
    DeviceRig rig;
    glm::dvec3 beside{0.0};            // m, push of the surfaces where tissue holds the tool
    glm::dvec3 layer_push{0.0};        // m, push of the layers in the last tick
    glm::dvec3 shaft_push{0.0};        // m, way of the tip by the turn that holds the shaft
    double shaft_weight = 0;           // weight of the relief that holds it
    std::optional<glm::dvec3> let_be;  // tip as the layers held it; nullopt: no contact
    ContactState contact;
    OutputState output;
    HandPush push = HandPush::kYes;
    bool is_remounted = false;  // since the last tick
    double entry = 1;           // factor of the tip force, 0 to 1 after a change of instrument
    bool has_sample = false;
    DeviceSample last;      // newest sample
    double age = 0;         // s, age of the newest sample
    double fresh_for = 0;   // s, least time for which a sample is fresh
    double hand_speed = 0;  // m/s, from the last two samples
    CouplingBlend tissue;
  };
  static void Forget(Tool& tool) noexcept;
  Fault Receive(Tool& tool, const DeviceSample& sample, double dt) noexcept;
  void PlaceField(std::size_t tissue, std::unique_ptr<FieldSurface> field);
  void FeelSolids() noexcept;
  LayerHold FeelLayers(Tool& tool, const glm::dvec3& portal, const glm::dvec3& held,
                       double stiffness, const ToolState& state) const noexcept;
  void TickShaft(Tool& tool, const glm::dvec3& portal, double travel, double stiffness,
                 ContactForce& contact, ToolState& state) const noexcept;
  void TickTool(Tool& tool, const DeviceSample& sample, const glm::dvec3& portal, double dt,
                ToolState& state) noexcept;

  SessionOptions options_;
  std::shared_ptr<const DepthField> field_;  // shared with the obstacle of the tissues
  std::vector<SurfaceBvh> meshes_;           // one per tissue; empty for deformable ones
  std::vector<SurfaceBvh>
      away_;  // bounding-volume hierarchies of deformable tissues while they are simulated as rigid
  std::vector<std::uint8_t> is_live_;
  std::vector<ImplicitBody> implicit_;                 // uncut; the tissue loop holds the cut ones
  std::vector<std::unique_ptr<FieldSurface>> fields_;  // one per tissue, or empty
  std::vector<const SweptSurface*> instead_;           // the same, as contact reads them
  std::vector<LayerUnder> layers_;                     // elastic layers, in contact with both tools
  Projection projection_;
  double radius_, spacing_, view_angle_;
  CameraHead head_;
  Disturbances disturbances_;
  Tool scope_, instrument_;
  Snapshot snapshot_;
  ToolKind kind_ = ToolKind::kProbe;
  std::array<ToolShape, static_cast<std::size_t>(ToolKind::kGrasper) + 1>
      shapes_;  // indexed by kind
  ToolShape scope_shape_;
  std::unique_ptr<TissueLoop> tissues_;
};

}  // namespace arthro::simulation
