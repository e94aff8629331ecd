// A practice session: two hands in, poses, contacts and forces out, one servo tick at a time
// [paper, 3.2, 3.4; method.md, Threads]. It draws nothing and has no threads: a servo thread calls
// Tick at 1 kHz where there is a force device, the window calls it in 1 ms steps where there is
// none. Both tools go the same way: rod pose, contact of the tip, output chain. Portal frame, m, N,
// s.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "simulation/device/device_sample.h"
#include "simulation/haptics/output_chain.h"
#include "simulation/haptics/surface_bvh.h"
#include "simulation/practice/field_surface.h"
#include "simulation/practice/session_options.h"
#include "simulation/practice/snapshot.h"
#include "simulation/practice/tissue_loop.h"
#include "simulation/scene/loaded_scene.h"
#include "simulation/tissue/body/tool_on_layers.h"
#include "simulation/tissue/contact/coupling.h"

namespace arthro::simulation {

class Session {
 public:
  // Without a depth map the bare sphere is felt where the panorama lies. A tissue without a surface
  // is not felt. A tissue that the scene calls implicit is sampled and touched as a function; its
  // surface must be closed: throws Error(kBadMesh). Copies what it needs from `loaded`.
  explicit Session(const LoadedScene& loaded, const SessionOptions& options = {});

  // Advances the session by dt. A sample that repeats its t grows older by dt each tick; after
  // max_sample_age its device gets no force. Call for fresh samples each tick.
  void Tick(const DeviceSample& scope, const DeviceSample& instrument, double dt) noexcept;
  const Snapshot& snapshot() const noexcept { return snapshot_; }

  // Live, between ticks, from the thread that ticks. A moved portal lets the instrument enter anew.
  void SetIncisionSpacing(double spacing) noexcept;
  double incision_spacing() const noexcept { return spacing_; }
  void SetViewAngle(double view_angle) noexcept { view_angle_ = view_angle; }
  double view_angle() const noexcept { return view_angle_; }
  // Contact, lever and limiter at once; the depth map's own options need a new session.
  void SetOptions(const SessionOptions& options) noexcept { options_ = options; }
  const SessionOptions& options() const noexcept { return options_; }

  // May the hand be pushed in the ticks to come? Without a device nobody is, and it may.
  void SetPush(DeviceRole role, HandPush push) noexcept {
    (role == DeviceRole::kScope ? scope_ : instrument_).push = push;
  }

  // A sample is fresh for so long even where the options say less, s: of a device that speaks too
  // seldom for them and has no force to be pushed with.
  void SetFreshFor(DeviceRole role, double seconds) noexcept {
    (role == DeviceRole::kScope ? scope_ : instrument_).fresh_for = seconds;
  }

  // From now on these tissues live: they deform, and are left out of the rigid surfaces. With
  // TissuePace::kInline the same inputs give the same bits. `layers` give way to both tools, all
  // along them, by their closed form, in the servo; their picture is beside the bodies'. One whose
  // surface is not closed stays rigid. What is a function of space is cut by the instrument, and
  // felt by the servo as it is then. Not on the servo path. Throws Error.
  void Enliven(std::vector<BodySpec> bodies, TissuePace pace, std::vector<LayerSpec> layers = {});
  // After each tick, by the same thread: the jaws and the tissue's own, slower clock. Inline it
  // steps here; on a thread this only hands the tool over.
  void TickTissues(double dt) noexcept;
  // The picture of them, from the one thread that draws; nullptr: none lives.
  const WorldPicture* tissues() noexcept { return tissues_ ? &tissues_->Read() : nullptr; }
  bool HasNewTissues() const noexcept { return tissues_ && tissues_->HasNew(); }
  void ResetTissues();  // whole and at rest again; not on the servo path
  // The instrument in the hand, between ticks. Another one enters anew, and its force rises from
  // zero within the ramp of the limiter, on the tip as on the hand: no force of the one before, nor
  // of a shape that appears inside tissue, is given or recorded.
  void SetInstrument(ToolKind kind) noexcept;
  ToolKind instrument() const noexcept { return kind_; }

  // Which tissues are computed as living ones, a flag each (missing: not); those are left out of
  // the rigid surfaces. Not on the servo path: it moves meshes.
  void SetLiveTissues(std::span<const std::uint8_t> is_live);
  // From now on this tissue is touched as a function and not as its mesh; null: as its mesh again.
  // Who bites of it edits a copy and gives that; after Enliven only for tissues that the scene does
  // not call implicit. Not on the servo path.
  void SetField(int tissue, std::shared_ptr<const ImplicitTissue> field);
  // What living tissue does to the instrument from now on; call with each step of the tissue, every
  // frame also when it rests, or the force fades. The same step again changes nothing. A faulty one
  // gives Fault::kTissue and no force until a good one comes.
  void SetCoupling(const ToolCoupling& coupling) noexcept;

  // How a hand's device is mounted on its incision, live, between ticks: a calibration found it.
  // The tool then is somewhere else at once, so it enters anew, and its hand is pushed gently at
  // first.
  void SetMount(DeviceRole role, const DeviceRig& mount) noexcept;
  const DeviceRig& scope_rig() const noexcept { return scope_.rig; }
  const DeviceRig& instrument_rig() const noexcept { return instrument_.rig; }

 private:
  struct Tool {
    DeviceRig rig;
    glm::dvec3 beside{0.0};            // m, how far surfaces hold it off where tissue has it
    glm::dvec3 layer_push{0.0};        // m, how far layers held it off its hand in the last tick
    std::optional<glm::dvec3> let_be;  // where they let its tip be then; none: it was away
    ContactState contact;
    OutputState output;
    HandPush push = HandPush::kYes;
    bool is_remounted = false;  // since the last tick
    double entry = 1;           // of its force on the tip: 0 to 1 after it was changed for another
    bool has_sample = false;
    DeviceSample last;      // the newest one
    double age = 0;         // s since it came
    double fresh_for = 0;   // s, at least
    double hand_speed = 0;  // m/s, between the last two
    CouplingBlend tissue;
  };
  static void Forget(Tool& tool) noexcept;
  Fault Receive(Tool& tool, const DeviceSample& sample, double dt) noexcept;
  void PlaceField(std::size_t tissue, std::unique_ptr<FieldSurface> field);
  void FeelSolids() noexcept;
  LayerHold FeelLayers(Tool& tool, const glm::dvec3& portal, const glm::dvec3& held,
                       double stiffness, const ToolState& state) const noexcept;
  void TickTool(Tool& tool, const DeviceSample& sample, const glm::dvec3& portal, double dt,
                ToolState& state) noexcept;

  SessionOptions options_;
  std::shared_ptr<const DepthField> field_;  // shared with what tissue rests on
  std::vector<SurfaceBvh> meshes_;           // one a tissue; of living ones nothing
  std::vector<SurfaceBvh> away_;             // what living ones are when they do not live
  std::vector<std::uint8_t> is_live_;
  std::vector<ImplicitBody> implicit_;                 // whole; what is cut is the tissue loop's
  std::vector<std::unique_ptr<FieldSurface>> fields_;  // one a tissue, or none at all
  std::vector<const SweptSurface*> instead_;           // the same, as contact takes them
  std::vector<LayerUnder> layers_;                     // that give way to both tools
  Projection projection_;
  double radius_, spacing_, view_angle_;
  Tool scope_, instrument_;
  Snapshot snapshot_;
  ToolKind kind_ = ToolKind::kProbe;
  std::array<ToolShape, static_cast<std::size_t>(ToolKind::kGrasper) + 1> shapes_;  // by kind
  ToolShape scope_shape_;
  std::unique_ptr<TissueLoop> tissues_;
};

}  // namespace arthro::simulation
