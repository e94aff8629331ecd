#include "simulation/practice/hands/practice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/practice/hands/blade_speed.h"
#include "simulation/practice/hands/offered_instruments.h"
#include "simulation/practice/living_tissues.h"
#include "simulation/scope/arthroscope.h"

namespace arthro::simulation {
namespace {

constexpr double kFrame = 1.0 / 60;  // s, time in which a hand moves to where it was led

// A window that showed no frame for this time cannot report that the dead-man was released.
constexpr double kWindowHangs = 0.5;  // s

}  // namespace

RodLimits ScopeLimits(const Scene& scene) {
  RodLimits limits;
  // Keeps the lens inside the sphere of the panorama and the hand outside the portal.
  limits.max_depth = std::min(0.97 * scene.backdrop.radius, 0.9 * scene.rig.scope.rod_length);
  limits.min_depth = -0.2 * scene.backdrop.radius;
  return limits;
}

RodLimits InstrumentLimits(const Scene& scene) {
  RodLimits limits;
  // Lets the tip press on the furthest wall, which then holds it.
  limits.max_depth = std::min(scene.backdrop.radius + std::abs(scene.portals.incision_spacing),
                              0.9 * scene.rig.instrument.rod_length);
  limits.min_depth = -0.2 * scene.backdrop.radius;
  return limits;
}

RodPose StartOfScope(const Scene& scene) {
  // Looks at the middle of the picture: the view axis is bent up by the centre angle, so the rod
  // points down by as much, to a limit.
  constexpr double kLowest = 0.8;  // rad
  RodPose pose;
  pose.depth = 0.3 * scene.backdrop.radius;
  pose.latitude =
      -std::min(kLowest, CentreAngle(scene.scope.view_angle, pose.depth, scene.backdrop.radius));
  return pose;
}

RodPose StartOfInstrument(const Scene& scene) {
  // Places the tip in the middle of the scope's first picture, a third of the way to the backdrop.
  constexpr double kShare = 0.33;
  const ScopeView view = ViewFromPose(StartOfScope(scene), scene.scope.view_angle);
  const glm::dvec3 wall = SphereHit(view.tip, view.view, scene.backdrop.radius);
  const glm::dvec3 portal(scene.portals.incision_spacing, 0.0, 0.0);
  const glm::dvec3 rod = view.tip + kShare * (wall - view.tip) - portal;
  RodPose pose;
  pose.depth = glm::length(rod);
  pose.latitude = std::atan2(-rod.y, std::hypot(rod.x, rod.z));
  pose.longitude = std::atan2(rod.x, rod.z);
  return pose;
}

Practice MakePractice(const LoadedScene& loaded, const std::vector<TissuePreset>& presets,
                      TissuePace pace, const SessionOptions& options) {
  if (OrEmpty(loaded.panorama).empty())
    throw Error(Code::kBadScene,
                "a scene without a panorama cannot be practised; import one first");
  auto session = std::make_unique<Session>(loaded, options);
  EnlivenTissues(*session, loaded, presets, pace);
  return {std::move(session), loaded};
}

Practice::Practice(std::unique_ptr<Session> session, const LoadedScene& loaded)
    : session_(std::move(session)),
      by_mouse_{ScriptedDevice(session_->scope_rig(), StartOfScope(loaded.scene),
                               ScopeLimits(loaded.scene)),
                ScriptedDevice(session_->instrument_rig(), StartOfInstrument(loaded.scene),
                               InstrumentLimits(loaded.scene))},
      eye_(loaded),
      offered_(OfferedInstruments(loaded.scene)),
      offered_by_scene_(offered_) {
  request_.options = session_->options();
  request_.incision_spacing = session_->incision_spacing();
  request_.view_angle = session_->view_angle();
  request_.head = session_->camera_head();
  request_.disturbances = session_->disturbances();
  mount_ = {session_->scope_rig(), session_->instrument_rig()};
  request_.instrument = session_->instrument();
  // Ticks once, so that there is a picture before time has passed.
  session_->Tick(scope().Sample(t_), instrument().Sample(t_), kServoPeriod);
  snapshot_ = session_->snapshot();
  tissues_ = session_->tissues();
  MoveEye();
}

void Practice::SetOptions(const SessionOptions& options, const Hands* hands) {
  const DepthFieldOptions depth = request_.options.depth;
  const BodyOptions tissue = request_.options.tissue;
  request_.options = options;
  request_.options.depth = depth;
  request_.options.tissue = tissue;
  if (hands != nullptr) hands->LowerLimits(request_.options);
}

void Practice::MoveEye() {
  if (tissues_ != nullptr) eye_.Follow(*tissues_);
  seen_from_ = eye_.MoveTo(snapshot_.scope);
}

void Practice::Begin(Hands* hands) {
  if (hands != nullptr) {
    held_ = hands->MakeHeldHands(by_mouse_);
    hands->LowerLimits(request_.options);
    has_thread_ = hands->NeedsThread();
  } else {
    const auto by_mouse = [](const ScriptedDevice& hand) {
      return HandParts{HandKind::kMouse, hand, {}, {}, {}, {}, 0, kNoButtons};
    };
    held_ = std::make_shared<HeldHands>(std::array{by_mouse(by_mouse_[0]), by_mouse(by_mouse_[1])},
                                        PedalParts{});
  }
  ServoOptions options;
  options.watches = {held_.get()};
  options.watches.insert(options.watches.end(), watches_.begin(), watches_.end());
  if (has_thread_)
    options.request_lasts = kWindowHangs;
  else
    options.period_without_force = kServoPeriod;
  servo_ = std::make_unique<ServoLoop>(*session_, held_->Of(DeviceRole::kScope),
                                       held_->Of(DeviceRole::kInstrument), options);
}

// The rod ends at the tip of the instrument that it holds now.
void Practice::MountInstrument(const Hands& hands) noexcept {
  auto& mount = request_.mount[Index(DeviceRole::kInstrument)];
  DeviceRig held = mount_[Index(DeviceRole::kInstrument)];
  held.rod_length += hands.TipBeyondRod(request_.instrument);
  if (mount || held.rod_length != mount_[Index(DeviceRole::kInstrument)].rod_length) mount = held;
}

// Sends poses, buttons, mounts and modes to the hands and the servo.
void Practice::SendRequests(Hands* hands, double until) noexcept {
  if (hands != nullptr) MountInstrument(*hands);
  HandsRequest request;
  request.until = until;
  for (std::size_t i = 0; i < 2; ++i) {
    request.hand[i].pose = by_mouse_[i].pose();
    request.hand[i].episode = episodes_[i];
  }
  request.hand[1].buttons = buttons_;
  for (std::size_t i = 0; i < 2; ++i) request.hand[i].mount = request_.mount[i];
  if (hands != nullptr) request.calibrated = hands->calibrated();
  held_->SetRequest(request);
  const bool is_held = hands != nullptr && hands->is_dead_man_held();
  request_.is_dead_man_held = {is_held, is_held};
  request_.is_zero_force = hands != nullptr && (hands->is_zero_force() || hands->calibrated());
  servo_->SetRequest(request_);
  if (hands != nullptr) Log(*hands);
}

// Logs what has changed of the state that the hands do not tell.
void Practice::Log(Hands& hands) noexcept {
  const double now = has_thread_ ? hands.Clock() : t_;
  LoggedWish wish;
  wish.view_angle = request_.view_angle;
  wish.incision_spacing = request_.incision_spacing;
  wish.instrument = static_cast<std::uint8_t>(request_.instrument);
  wish.resets = resets_;
  wish.is_complete = true;
  wish.is_head_upright = request_.head.is_upright;
  wish.head_turn = request_.head.turn;
  wish.disturbance = StrengthsOf(request_.disturbances);
  wish.disturbance_seed = request_.disturbances.seed;
  for (const DeviceRole role : kDeviceRoles) {
    const DeviceRig& mount = request_.mount[Index(role)].value_or(mount_[Index(role)]);
    wish.mount[Index(role)] = {mount.pivot, mount.portal_from_device, mount.rod_length};
  }
  if (logged_ != wish) hands.LogWish(now, wish);
  logged_ = wish;
  const OptionsInForce& in_force = servo_->ReadOptions();
  const OptionNumbers numbers = NumbersOf(in_force.options);
  for (int i = 0; i < numbers.count; ++i)
    if (i >= logged_options_.count || !(logged_options_.option[i] == numbers.option[i]))
      hands.LogOption(std::min(now, in_force.since), numbers.option[i]);
  logged_options_ = numbers;
}

void Practice::TakeReports() {
  snapshot_ = servo_->ReadSnapshot();
  tissues_ = session_->tissues();
  MoveEye();
  const HandsReport& report = held_->ReadReport();
  peak_force_ = report.peak_force;
  running_ = report.running;
  // Mouse and keys continue from where a device holds the hand, or left it.
  for (const DeviceRole role : kDeviceRoles) {
    const HandsReport::Hand& hand = report.hand[Index(role)];
    int& episode = episodes_[Index(role)];
    if (hand.is_led_by_device || hand.episode != episode)
      by_mouse_[Index(role)].Set(ToolOf(snapshot_, role).pose);
    episode = hand.episode;
  }
  if (std::exchange(next_presses_, report.next_presses) == report.next_presses) return;
  SetInstrument(NextOffered(offered_, instrument_kind()));
}

void Practice::Advance(double seconds, Hands* hands) {
  if (!servo_) Begin(hands);
  if (has_thread_) {
    SendRequests(hands, hands->Clock() + kFrame);
    servo_->Start();
    servo_sentence_ = DescribeTrouble(servo_->ReadReport());
  } else {
    pending_ += std::clamp(seconds, 0.0, kLongestPause);
    const int ticks = static_cast<int>(std::floor(pending_ / kServoPeriod + 1e-9));
    pending_ -= ticks * kServoPeriod;
    SendRequests(hands, t_ + ticks * kServoPeriod);
    for (int tick = 0; tick < ticks; ++tick) servo_->TickOnce(t_ += kServoPeriod);
    if (ticks == 0) return;
  }
  TakeReports();
}

void Practice::Offer(std::vector<ToolKind> instruments, std::vector<double> view_angles) {
  offered_ = instruments.empty() ? offered_by_scene_ : std::move(instruments);
  std::ranges::sort(offered_);
  offered_angles_ = std::move(view_angles);
}

bool Practice::Offers(ToolKind kind) const { return std::ranges::count(offered_, kind) > 0; }

bool Practice::OffersAngle(double view_angle) const {
  constexpr double kSame = 1e-6;  // rad
  return offered_angles_.empty() || std::ranges::any_of(offered_angles_, [&](double angle) {
           return std::abs(angle - view_angle) < kSame;
         });
}

void Practice::SetMount(DeviceRole role, const DeviceRig& mount) {
  request_.mount[Index(role)] = mount_[Index(role)] = mount;
}

void Practice::ResetTissues() {
  if (has_thread_) servo_->Stop();  // the next Advance starts it again
  session_->ResetTissues();
  ++resets_;
}

void Practice::AddWatch(ServoWatch& watch) {
  watches_.push_back(&watch);
  if (!servo_) return;
  if (has_thread_) servo_->Stop();  // the next Advance starts it again
  servo_->AddWatch(&watch);
}

void Practice::RemoveWatch(ServoWatch& watch) {
  std::erase(watches_, &watch);
  if (!servo_) return;
  if (has_thread_) servo_->Stop();
  servo_->RemoveWatch(&watch);
}

double Practice::blade_turn() const { return kBladeSpeed * running_; }

}  // namespace arthro::simulation
