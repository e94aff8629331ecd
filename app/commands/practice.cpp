#include "app/commands/practice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/scope/arthroscope.h"
#include "simulation/session/living_tissues.h"

namespace arthro::app {
namespace {

using simulation::DeviceRole;

constexpr double kTick = 1e-3;  // s

constexpr double kFrame = 1.0 / 60;  // s, in which a hand gets where it was led

// A window that has shown no frame for so long cannot tell that the dead-man was let go.
constexpr double kWindowHangs = 0.5;  // s

// As slow as an eye follows; a real blade turns fifty times a second, which a picture at 60 Hz
// would show standing still.
constexpr double kBladeSpeed = 30.0;  // rad/s

simulation::Session MakeLiveSession(const authoring::Document& document,
                                    const std::vector<simulation::TissuePreset>& presets,
                                    simulation::TissuePace pace,
                                    const simulation::SessionOptions& options) {
  if (!document.panorama || document.panorama->empty())
    throw Error(Code::kBadScene,
                "a scene without a panorama cannot be practised; import one first");
  simulation::Session session(document, options);
  simulation::EnlivenTissues(session, document, presets, pace);
  return session;
}

}  // namespace

simulation::RodLimits ScopeLimits(const Scene& scene) {
  simulation::RodLimits limits;
  // The lens stays inside the sphere that the panorama is on, and the hand outside the portal.
  limits.max_depth = std::min(0.97 * scene.backdrop.radius, 0.9 * scene.rig.scope.rod_length);
  limits.min_depth = -0.2 * scene.backdrop.radius;
  return limits;
}

simulation::RodLimits InstrumentLimits(const Scene& scene) {
  simulation::RodLimits limits;
  // Far enough to press on the furthest wall; the wall holds the tip.
  limits.max_depth = std::min(scene.backdrop.radius + std::abs(scene.portals.incision_spacing),
                              0.9 * scene.rig.instrument.rod_length);
  limits.min_depth = -0.2 * scene.backdrop.radius;
  return limits;
}

simulation::RodPose StartOfScope(const Scene& scene) {
  // Looking at the middle of the picture, as far as the view angle lets the rod: the axis is bent
  // up by the centre angle, so the rod points down by as much.
  constexpr double kLowest = 0.8;  // rad
  simulation::RodPose pose;
  pose.depth = 0.3 * scene.backdrop.radius;
  pose.latitude = -std::min(
      kLowest, simulation::CentreAngle(scene.scope.view_angle, pose.depth, scene.backdrop.radius));
  return pose;
}

simulation::RodPose StartOfInstrument(const Scene& scene) {
  // Its tip in the middle of the scope's first picture, a third of the way to the backdrop.
  constexpr double kShare = 0.33;
  const simulation::ScopeView view =
      simulation::ViewFromPose(StartOfScope(scene), scene.scope.view_angle);
  const glm::dvec3 wall = simulation::SphereHit(view.tip, view.view, scene.backdrop.radius);
  const glm::dvec3 portal(scene.portals.incision_spacing, 0.0, 0.0);
  const glm::dvec3 rod = view.tip + kShare * (wall - view.tip) - portal;
  simulation::RodPose pose;
  pose.depth = glm::length(rod);
  pose.latitude = std::atan2(-rod.y, std::hypot(rod.x, rod.z));
  pose.longitude = std::atan2(rod.x, rod.z);
  return pose;
}

Practice::Practice(const authoring::Document& document,
                   const std::vector<simulation::TissuePreset>& presets,
                   simulation::TissuePace pace, const simulation::SessionOptions& options)
    : session_(
          std::make_unique<simulation::Session>(MakeLiveSession(document, presets, pace, options))),
      by_mouse_{
          simulation::ScriptedDevice(session_->scope_rig(), StartOfScope(document.scene),
                                     ScopeLimits(document.scene)),
          simulation::ScriptedDevice(session_->instrument_rig(), StartOfInstrument(document.scene),
                                     InstrumentLimits(document.scene))} {
  wish_.options = session_->options();
  wish_.incision_spacing = session_->incision_spacing();
  wish_.view_angle = session_->view_angle();
  wish_.instrument = session_->instrument();
  // One tick, so that there is something to show before time has passed.
  session_->Tick(scope().Sample(t_), instrument().Sample(t_), kTick);
  snapshot_ = session_->snapshot();
  tissues_ = session_->tissues();
}

void Practice::Begin(Hands* hands) {
  if (hands != nullptr) {
    held_ = hands->Hold(by_mouse_);
    hands->Lower(wish_.options);
    has_thread_ = hands->NeedsThread();
  } else {
    const auto by_mouse = [](const simulation::ScriptedDevice& hand) {
      return HandParts{HandKind::kMouse, hand, {}, {}, {}, {}, 0, kNoButtons};
    };
    held_ = std::make_shared<HeldHands>(std::array{by_mouse(by_mouse_[0]), by_mouse(by_mouse_[1])},
                                        PedalParts{});
  }
  simulation::ServoOptions options;
  options.watch = held_.get();
  if (has_thread_)
    options.wish_lasts = kWindowHangs;
  else
    options.period_without_force = kTick;
  servo_ = std::make_unique<simulation::ServoLoop>(*session_, held_->Of(DeviceRole::kScope),
                                                   held_->Of(DeviceRole::kInstrument), options);
}

// What the hands and the servo are to do until then.
void Practice::Tell(Hands* hands, double until) noexcept {
  HandsWish wish;
  wish.until = until;
  for (std::size_t i = 0; i < 2; ++i) {
    wish.hand[i].pose = by_mouse_[i].pose();
    wish.hand[i].episode = episodes_[i];
  }
  wish.hand[1].buttons = buttons_;
  for (std::size_t i = 0; i < 2; ++i) wish.hand[i].mount = wish_.mount[i];
  if (hands != nullptr) wish.calibrated = hands->calibrated();
  held_->Wish(wish);
  const bool is_held = hands != nullptr && hands->is_dead_man_held();
  wish_.is_dead_man_held = {is_held, is_held};
  wish_.is_zero_force = hands != nullptr && (hands->is_zero_force() || hands->calibrated());
  servo_->Wish(wish_);
}

void Practice::TakeNews() {
  snapshot_ = servo_->Read();
  tissues_ = session_->tissues();
  const HandsNews& news = held_->News();
  peak_force_ = news.peak_force;
  running_ = news.running;
  // Mouse and keys go on from where a device has the hand, or left it.
  for (std::size_t i = 0; i < 2; ++i) {
    const HandsNews::Hand& hand = news.hand[i];
    if (hand.is_led_by_device || hand.episode != episodes_[i])
      by_mouse_[i].Set(i == 0 ? snapshot_.scope.pose : snapshot_.instrument.pose);
    episodes_[i] = hand.episode;
  }
  if (std::exchange(next_presses_, news.next_presses) == news.next_presses) return;
  const bool is_last = instrument_kind() == simulation::ToolKind::kGrasper;
  SetInstrument(is_last
                    ? simulation::ToolKind::kProbe
                    : static_cast<simulation::ToolKind>(static_cast<int>(instrument_kind()) + 1));
}

void Practice::Advance(double seconds, Hands* hands) {
  if (!servo_) Begin(hands);
  if (has_thread_) {
    Tell(hands, hands->Clock() + kFrame);
    servo_->Start();
    servo_sentence_ = SentenceOf(servo_->ReadReport());
  } else {
    pending_ += std::clamp(seconds, 0.0, kLongestPause);
    const int ticks = static_cast<int>(std::floor(pending_ / kTick + 1e-9));
    pending_ -= ticks * kTick;
    Tell(hands, t_ + ticks * kTick);
    for (int tick = 0; tick < ticks; ++tick) servo_->TickOnce(t_ += kTick);
    if (ticks == 0) return;
  }
  TakeNews();
}

void Practice::SetMount(DeviceRole role, const DeviceRig& mount) {
  wish_.mount[static_cast<std::size_t>(role)] = mount;
}

void Practice::ResetTissues() {
  if (has_thread_) servo_->Stop();  // the next Advance starts it
  session_->ResetTissues();
}

double Practice::blade_turn() const { return kBladeSpeed * running_; }

}  // namespace arthro::app
