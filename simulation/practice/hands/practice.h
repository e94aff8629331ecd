// A practice: a session, its servo and the hands that hold it. With mouse and keys, recorded or
// simulated hands, the window drives the servo in ticks of 1 ms, as many as time has passed, so
// that the same input gives the same pictures. Plugged-in devices need a servo thread, which keeps
// its own time.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulation/practice/hands/hands.h"
#include "simulation/practice/replay/option_numbers.h"
#include "simulation/practice/scope_eye.h"
#include "simulation/practice/scripted_device.h"
#include "simulation/practice/servo_loop.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/tissue/body/tissue_preset.h"

namespace arthro::simulation {

class Practice {
 public:
  // Takes a session of `loaded`, deformable tissues included.
  Practice(std::unique_ptr<Session> session, const LoadedScene& loaded);

  // Advances the session by `seconds`, or reads what its thread did meanwhile. The hands move at
  // constant speed to their present pose. Of a pause longer than kLongestPause the rest is skipped.
  // `hands` are used from the first call on and must outlive this; null: mouse and keys hold both
  // hands. A hand whose device reports no position stays where it was.
  void Advance(double seconds, Hands* hands = nullptr);
  static constexpr double kLongestPause = 0.1;  // s

  // State after the last Advance.
  const Snapshot& snapshot() const { return snapshot_; }
  // Pose of the rod to the eye from which the picture is drawn.
  const RodPose& seen_from() const { return seen_from_; }
  const ScopeEye& eye() const { return eye_; }
  const DepthField& relief() const { return session_->relief(); }
  double incision_spacing() const { return request_.incision_spacing; }
  // Moves the incision of the instrument for this session; the tool enters anew.
  void SetIncisionSpacing(double spacing) { request_.incision_spacing = spacing; }
  // Takes contact, lever, passivity, thermal and limiter at once; depth field and tissue stay as
  // they are. A rig of `hands` lowers the limits; null: mouse and keys.
  void SetOptions(const SessionOptions& options, const Hands* hands);
  double view_angle() const { return request_.view_angle; }
  void SetViewAngle(double view_angle) { request_.view_angle = view_angle; }
  // Camera head and disturbances of the picture.
  void SetCameraHead(const CameraHead& head) { request_.head = head; }
  void SetDisturbances(const Disturbances& disturbances) { request_.disturbances = disturbances; }

  // Deformable tissues after the last Advance; nullptr: there are none.
  const WorldPicture* tissues() const { return tissues_; }
  void ResetTissues();
  // Offers these instruments and view angles alone (rad), as an exercise asks; empty: all of the
  // scene, and any angle.
  void Offer(std::vector<ToolKind> instruments, std::vector<double> view_angles);
  bool Offers(ToolKind kind) const;
  bool OffersAngle(double view_angle) const;
  const std::vector<ToolKind>& offered() const { return offered_; }
  ToolKind instrument_kind() const { return request_.instrument; }
  void SetInstrument(ToolKind kind) { request_.instrument = kind; }
  // Sets the mount of a hand's device, after its incision was calibrated.
  void SetMount(DeviceRole role, const DeviceRig& mount);
  // Presses or releases the button of the instrument: jaws close, a shaver runs.
  void Press(bool is_pressed) { buttons_ = is_pressed ? 1u : 0u; }
  double blade_turn() const;  // rad, turn of the shaver's blade as drawn

  // Adds a watch of the ticks, such as the frames of an attempt, and removes it before it ends.
  void AddWatch(ServoWatch& watch);
  void RemoveWatch(ServoWatch& watch);

  double peak_force() const { return peak_force_; }  // N, largest on the instrument's tip so far
  // Trouble of the servo thread, for the user; empty: none.
  const std::string& servo_sentence() const { return servo_sentence_; }
  // Newest report of the force loop, for the thread that calls Advance; nullptr before its first
  // call.
  const ServoReport* servo_report() const { return servo_ ? &servo_->ReadReport() : nullptr; }

  // Hands as mouse and keys lead them.
  ScriptedDevice& scope() { return by_mouse_[0]; }
  ScriptedDevice& instrument() { return by_mouse_[1]; }

 private:
  void Begin(Hands* hands);
  void SendRequests(Hands* hands, double until) noexcept;
  void MountInstrument(const Hands& hands) noexcept;
  void TakeReports();
  void MoveEye();

  // Pointers, since the servo refers to them and this is moved.
  std::unique_ptr<Session> session_;
  std::array<ScriptedDevice, 2> by_mouse_;  // indexed by DeviceRole
  ServoRequest request_;
  void Log(Hands& hands) noexcept;
  std::optional<LoggedWish> logged_;  // last wish in the log
  // Indexed by DeviceRole: at the beginning, or as it was calibrated; without the instrument's tip.
  std::array<DeviceRig, 2> mount_;
  OptionNumbers logged_options_;  // last options in the log
  std::uint32_t resets_ = 0;
  Snapshot snapshot_;
  ScopeEye eye_;
  RodPose seen_from_;
  std::uint32_t buttons_ = 0;
  std::array<int, 2> episodes_{};  // HandsReport::Hand::episode
  double t_ = 0, pending_ = 0, peak_force_ = 0, running_ = 0;
  int next_presses_ = 0;
  std::vector<ToolKind> offered_, offered_by_scene_;  // instruments, in the order of ToolKind
  std::vector<double> offered_angles_;                // rad; empty: any
  bool has_thread_ = false;
  std::string servo_sentence_;
  const WorldPicture* tissues_ = nullptr;
  std::vector<ServoWatch*> watches_;  // beside the hands
  std::shared_ptr<HeldHands> held_;   // see Hands::MakeHeldHands
  std::unique_ptr<ServoLoop> servo_;  // last member: it uses the others, and ends without force
};

// Poses of both hands when a practice or the editor begins: the scope a third of the way in, the
// tip of the instrument in the middle of its picture.
RodPose StartOfScope(const Scene& scene);
RodPose StartOfInstrument(const Scene& scene);
RodLimits ScopeLimits(const Scene& scene);
RodLimits InstrumentLimits(const Scene& scene);

// Builds the session with its tissues, which takes a moment: call it in a job. Throws Error where
// the scene cannot be practised: no panorama, or a material that is not among the presets. With
// TissuePace::kInline the same input gives the same pictures.
Practice MakePractice(const LoadedScene& loaded, const std::vector<TissuePreset>& presets,
                      TissuePace pace, const SessionOptions& options = {});

}  // namespace arthro::simulation
