// Seeded random hand on a meniscus crescent (meniscus_body.h) with the motions of a trainee in ten
// minutes and the failures of a device. It moves smoothly over, through and under the tissue,
// changes instruments, bites, shaves, jumps and disappears for a while. Now and then its pose is
// not finite. A punch and a shaver are mostly guided to the free edge, because random motion hardly
// cuts. Portal frame, m, s.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "simulation/core/random.h"
#include "simulation/tissue/body/tissue_world.h"

namespace arthro::test {

class RandomHand {
 public:
  RandomHand(std::uint64_t seed, const Rigid3& portal_from_body)
      : random_(seed), portal_from_body_(portal_from_body) {
    for (Wave& wave : waves_) {
      wave.phase = random_.Uniform(0, 2 * std::numbers::pi);
      wave.rate = random_.Uniform(0.25, 1.1);  // rad/s
    }
  }

  simulation::Instrumentation Next(double dt) {
    t_ += dt;
    Change();
    const auto wave = [this](int i) {
      const Wave& a = waves_[2 * i];
      const Wave& b = waves_[2 * i + 1];
      return 0.65 * std::sin(a.rate * t_ + a.phase) + 0.35 * std::sin(2.7 * b.rate * t_ + b.phase);
    };
    // Cylinder coordinates of the crescent: 120° to each side, 6 to 24 mm out, 6 mm below to 14 mm
    // above its underside. The tip moves at about 30 mm/s, at most 100 mm/s.
    const double angle = 2.1 * wave(0), radius = 0.015 + 0.009 * wave(1);
    const double height = 0.004 + 0.010 * wave(2);
    const glm::dquat tilt = glm::angleAxis(0.9 * wave(3), glm::dvec3(1, 0, 0)) *
                            glm::angleAxis(0.9 * wave(4), glm::dvec3(0, 1, 0)) *
                            glm::angleAxis(std::numbers::pi * wave(5), glm::dvec3(0, 0, 1));
    // The rod comes from above: tool z is the tissue's −z, tilted.
    Rigid3 body_from_tool{glm::angleAxis(std::numbers::pi, glm::dvec3(1, 0, 0)) * tilt,
                          {radius * std::cos(angle), radius * std::sin(angle), height}};
    const double jaw = std::fmod(kJawRate * t_, 2 * std::numbers::pi);
    if (is_aimed_ && kind_ == simulation::ToolKind::kPunch)
      body_from_tool = AtEdge(angle, jaw);
    else if (is_aimed_ && kind_ == simulation::ToolKind::kShaver)
      body_from_tool = AlongEdge(angle, wave(2));

    simulation::Instrumentation hand;
    hand.kind = kind_;
    hand.now.is_present = t_ >= away_until_;
    hand.now.portal_from_tool = portal_from_body_ * body_from_tool;
    hand.now.opening = 0.5 + 0.5 * std::sin(jaw);
    hand.now.is_running = kind_ == simulation::ToolKind::kShaver && wave(6) > -0.3;
    if (random_.Uniform(0, 1) < 0.004) Spoil(hand.now);
    return hand;
  }

  int bad_poses() const { return bad_poses_; }
  int jumps() const { return jumps_; }

 private:
  static constexpr double kJawRate = 7.0;  // rad/s
  struct Wave {
    double phase = 0, rate = 0;
  };

  // Jaws around the free edge, 1.5 mm high at 10 mm from the axis. The rod points outwards, one jaw
  // above and one below. They reach furthest, 4 mm past the edge, when they close.
  static Rigid3 AtEdge(double angle, double jaw) {
    const glm::dvec3 out(std::cos(angle), std::sin(angle), 0), up(0, 0, 1);
    const double reach = 0.010 + 0.001 + 0.003 * std::cos(jaw - 1.2 * std::numbers::pi);
    return {glm::quat_cast(glm::dmat3(glm::cross(up, out), up, out)),
            reach * out + glm::dvec3(0, 0, 0.0006)};
  }
  // Window at the free edge: the rod points down inside the edge and the window faces outwards. It
  // leaves the edge now and then.
  static Rigid3 AlongEdge(double angle, double wave) {
    const glm::dvec3 out(std::cos(angle), std::sin(angle), 0), down(0, 0, -1);
    return {glm::quat_cast(glm::dmat3(glm::cross(out, down), out, down)),
            (0.0085 + 0.002 * wave) * out + glm::dvec3(0, 0, -0.003)};
  }

  // Changes the instrument, jumps or removes it every few seconds.
  void Change() {
    if (t_ < change_at_) return;
    change_at_ = t_ + random_.Uniform(0.8, 4.0);
    is_aimed_ = random_.Uniform(0, 1) < 0.7;
    const double what = random_.Uniform(0, 1);
    using enum simulation::ToolKind;
    if (what < 0.25)
      kind_ = kProbe;
    else if (what < 0.45)
      kind_ = kPunch;
    else if (what < 0.60)
      kind_ = kShaver;
    else if (what < 0.68)
      kind_ = kGrasper;
    else if (what < 0.71)
      kind_ = kNone;
    else if (what < 0.80)
      away_until_ = t_ + random_.Uniform(0.02, 1.0);
    else {
      ++jumps_;
      for (Wave& wave : waves_) wave.phase += random_.Uniform(-0.6, 0.6);
    }
  }

  void Spoil(simulation::ToolInput& input) {
    ++bad_poses_;
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    switch (random_.Below(6)) {
      case 0:
        input.portal_from_tool.translation.y = kNan;
        break;
      case 1:
        input.portal_from_tool.translation = glm::dvec3(kInfinity, 0, -kInfinity);
        break;
      case 2:
        input.portal_from_tool.rotation.w = kNan;
        break;
      case 3:
        input.portal_from_tool.translation = glm::dvec3(1e300);
        break;
      case 4:
        input.portal_from_tool.translation.x += 1e6;
        break;
      default:
        input.opening = kNan;
    }
  }

  Random random_;
  Rigid3 portal_from_body_;
  std::array<Wave, 14> waves_{};
  // Starts with bites, so that a short session also cuts.
  simulation::ToolKind kind_ = simulation::ToolKind::kPunch;
  bool is_aimed_ = true;
  double t_ = 0, change_at_ = 2.0, away_until_ = 0;
  int bad_poses_ = 0, jumps_ = 0;
};

}  // namespace arthro::test
