#include "simulation/training/observe/live_attempt.h"

#include <algorithm>

namespace arthro::simulation {

namespace {

// A body on a surface lies above it, as a ball that touches it.
std::optional<LiveFrames::Loose> LooseOf(const LoadedScene& loaded,
                                         std::span<const TargetPlace> targets,
                                         const DepthField& relief) {
  std::vector<int> numbers;
  std::vector<LooseBody> bodies;
  std::vector<Ball> goals;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const TargetPlace& target = targets[i];
    if (target.keeps_bodies) goals.push_back({target.point, target.radius});
    if (!target.is_loose) continue;
    glm::dvec3 place = target.point, normal = target.normal;
    if (target.tissue >= 0) {
      const Pose& pose = loaded.scene.tissues.at(static_cast<std::size_t>(target.tissue)).pose;
      place = Rigid3{pose.quaternion, pose.position} * place;
      normal = pose.quaternion * normal;
    }
    numbers.push_back(static_cast<int>(i));
    bodies.push_back({place + target.radius * normal, target.radius, false, true});
  }
  if (bodies.empty()) return {};
  return LiveFrames::Loose{std::move(numbers),
                           LooseBodies(loaded, std::move(bodies), relief, std::move(goals))};
}

}  // namespace

LiveAttempt::LiveAttempt(const LoadedScene& loaded, const std::vector<TargetPlace>& targets,
                         const DepthField& relief, const ScopeEye& eye)
    : frames_(LooseOf(loaded, targets, relief)),
      taken_(loaded, targets),
      observer_(loaded, targets, relief, eye) {}

void LiveFrames::AfterTick(const Snapshot& snapshot, double dt) noexcept {
  if (!ticks_) ticks_.emplace(snapshot.t - dt);
  // A frame that this tick ends has the bodies as they were before it.
  ticks_->Add(snapshot.t, snapshot, is_paused_.load());
  Numbered ended;
  while (ticks_->Take(ended.frame)) {
    if (loose_)
      for (std::size_t i = 0; i < loose_->target.size(); ++i)
        ended.frame.sight.target[static_cast<std::size_t>(loose_->target[i])].place =
            glm::vec3(loose_->bodies.all()[i].place);
    ended.number = pushed_++;
    queue_.Push(ended);  // a full queue is seen by the next number
  }
  if (loose_) loose_->bodies.Tick(snapshot, dt);
}

bool LiveFrames::Take(AttemptFrame& frame) noexcept {
  if (!ahead_) {
    const Numbered* front = queue_.Front();
    if (front == nullptr) return false;
    ahead_ = *front;
    queue_.Pop();
  }
  frame = AttemptFrame();
  if (taken_++ < ahead_->number) return true;
  frame = ahead_->frame;
  ahead_.reset();
  return true;
}

std::span<const AttemptFrame> LiveAttempt::Update(const WorldPicture* world) {
  ended_.clear();
  for (AttemptFrame frame; frames_.Take(frame);) ended_.push_back(frame);
  if (ended_.empty()) return {};
  if (world != nullptr) observer_.Follow(*world);
  for (AttemptFrame& frame : ended_) {
    observer_.Observe(frame);
    taken_.Measure(world, frame);
  }
  return ended_;
}

}  // namespace arthro::simulation
