#include "simulation/training/metrics/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/training/metrics/hand_path.h"
#include "simulation/training/metrics/metric_collector.h"
#include "simulation/training/metrics/smoothness.h"

namespace arthro::simulation {
namespace {

constexpr double kIdle = 0.005;  // m/s; a slower tool rests
// m/s that a movement whose smoothness is measured reaches: tremor of a hand at rest is slower, and
// so is rounding of the frames.
constexpr double kLeastMovement = 0.001;
// m/s, rms, by which a speed varies that is compared with another one; less is rounding.
constexpr double kLeastVariation = 1e-6;
constexpr double kShortestLeg = 1.0;    // s, of movement whose smoothness is measured
constexpr double kReleasedAfter = 0.3;  // s without a touch, after which another contact begins

const char* PartOf(DeviceRole role) { return role == DeviceRole::kScope ? "scope" : "instrument"; }

// All that the metrics of one tool read.
struct Hand {
  std::span<const AttemptFrame> frames;
  DeviceRole role;
  std::vector<HandPath> paths;
  const ToolFrame& at(std::size_t k) const { return frames[k].tool[Index(role)]; }
  double measured() const {
    double time = 0;
    for (const HandPath& path : paths) time += path.duration();
    return time;
  }
};

double TaskTime(std::span<const AttemptFrame> frames) {
  return kFrameTime *
         static_cast<double>(std::count_if(frames.begin(), frames.end(),
                                           [](const auto& f) { return !f.is_paused; }));
}

// Sum over neighbouring frames of each stretch.
double SumOfSteps(const Hand& hand,
                  const std::function<double(const HandPath&, std::size_t)>& step) {
  double sum = 0;
  for (const HandPath& path : hand.paths)
    for (std::size_t k = 1; k < path.tip.size(); ++k) sum += step(path, k);
  return sum;
}

glm::dvec3 AxisAt(const Hand& hand, const HandPath& path, std::size_t k) {
  return glm::dvec3(hand.at(path.first + k).axis);
}

double DepthStep(const Hand& hand, const HandPath& path, std::size_t k) {
  const glm::dvec3 axis = AxisAt(hand, path, k) + AxisAt(hand, path, k - 1);
  if (!(glm::length(axis) > 0)) return 0;
  return std::abs(glm::dot(path.tip[k] - path.tip[k - 1], glm::normalize(axis)));
}

double TurnStep(const Hand& hand, const HandPath& path, std::size_t k) {
  const double chord = glm::distance(AxisAt(hand, path, k), AxisAt(hand, path, k - 1));
  return 2 * std::asin(std::min(1.0, 0.5 * chord));
}

double RollStep(const Hand& hand, const HandPath& path, std::size_t k) {
  const std::size_t frame = path.first + k;
  return std::abs(static_cast<double>(hand.at(frame).roll) - hand.at(frame - 1).roll);
}

// Median of what `measure` gives for the stretches that are long enough and in which the tool
// moves.
std::optional<double> MedianOfLegs(
    const Hand& hand,
    const std::function<std::optional<double>(std::span<const double>)>& measure) {
  std::vector<double> values;
  for (const HandPath& path : hand.paths)
    if (path.duration() >= kShortestLeg &&
        *std::max_element(path.speed.begin(), path.speed.end()) >= kLeastMovement)
      if (const auto value = measure(path.speed)) values.push_back(*value);
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

// Speeds of both tools in the frames in which both are measured.
std::vector<std::array<double, 2>> SpeedsOfBoth(const std::array<Hand, 2>& hands,
                                                std::size_t frames) {
  std::array<std::vector<double>, 2> speed;
  for (std::size_t i = 0; i < 2; ++i) {
    speed[i].assign(frames, -1.0);
    for (const HandPath& path : hands[i].paths)
      std::copy(path.speed.begin(), path.speed.end(),
                speed[i].begin() + static_cast<std::ptrdiff_t>(path.first));
  }
  std::vector<std::array<double, 2>> both;
  for (std::size_t k = 0; k < frames; ++k)
    if (speed[0][k] >= 0 && speed[1][k] >= 0) both.push_back({speed[0][k], speed[1][k]});
  return both;
}

// Pearson's coefficient; nothing where one of them does not vary.
std::optional<double> Correlation(const std::vector<std::array<double, 2>>& pairs) {
  std::array<double, 2> mean{};
  for (const auto& pair : pairs)
    for (std::size_t i = 0; i < 2; ++i) mean[i] += pair[i] / static_cast<double>(pairs.size());
  double product = 0;
  std::array<double, 2> square{};
  for (const auto& pair : pairs) {
    product += (pair[0] - mean[0]) * (pair[1] - mean[1]);
    for (std::size_t i = 0; i < 2; ++i) square[i] += std::pow(pair[i] - mean[i], 2);
  }
  const double least = static_cast<double>(pairs.size()) * kLeastVariation * kLeastVariation;
  if (!(square[0] > least && square[1] > least)) return std::nullopt;
  return product / std::sqrt(square[0] * square[1]);
}

struct ContactSum {
  int count = 0;
  double time = 0, path = 0, impulse = 0;
};

// Contacts of a tool with one surface. A pause or an unknown hand ends no contact by itself.
ContactSum ContactsOf(const Hand& hand, int surface) {
  ContactSum sum;
  double since = kReleasedAfter;  // s since the last touch
  std::vector<const glm::dvec3*> tips(hand.frames.size(), nullptr);
  for (const HandPath& path : hand.paths)
    for (std::size_t k = 0; k < path.tip.size(); ++k) tips[path.first + k] = &path.tip[k];
  for (std::size_t k = 0; k < hand.frames.size(); ++k) {
    if (hand.frames[k].is_paused) continue;
    const ToolFrame& tool = hand.at(k);
    if (tool.contact != surface) {
      since += kFrameTime;
      continue;
    }
    if (since >= kReleasedAfter) ++sum.count;
    since = 0;
    sum.time += kFrameTime * static_cast<double>(tool.contact_share);
    sum.impulse += kFrameTime * static_cast<double>(tool.mean_force);
    if (k > 0 && tips[k] != nullptr && tips[k - 1] != nullptr)
      sum.path += glm::distance(*tips[k], *tips[k - 1]);
  }
  return sum;
}

void MeasureMotion(const Hand& hand, double task_time, MetricCollector& values) {
  const std::string part = PartOf(hand.role);
  const double measured = hand.measured();
  values.Give("measured_share", part,
              task_time > 0 ? std::optional(measured / task_time) : std::nullopt,
              "the attempt has no time");
  constexpr std::string_view kWhy = "the tool was never in the joint for three frames on end";
  const auto give = [&](std::string_view id, const std::function<double()>& value) {
    values.Give(id, part, measured > 0 ? std::optional(value()) : std::nullopt, kWhy);
  };
  give("path", [&] {
    return SumOfSteps(hand, [](const HandPath& path, std::size_t k) {
      return glm::distance(path.tip[k], path.tip[k - 1]);
    });
  });
  using Step = double (*)(const Hand&, const HandPath&, std::size_t);
  for (const auto& [id, step] : {std::pair<const char*, Step>{"depth_path", DepthStep},
                                 {"turn", TurnStep},
                                 {"roll_path", RollStep}})
    give(id, [&, step = step] {
      return SumOfSteps(hand,
                        [&](const HandPath& path, std::size_t k) { return step(hand, path, k); });
    });
  for (const auto& [id, least] :
       {std::pair{"moves_20", 0.02}, {"moves_50", 0.05}, {"moves_100", 0.1}})
    give(id, [&, least = least] {
      int count = 0;
      for (const HandPath& path : hand.paths) count += MoveCount(path.speed, least);
      return 60.0 * count / measured;
    });
  constexpr std::string_view kNoLeg = "no unbroken stretch of 1 s in which the tool moves";
  values.Give("sparc", part, MedianOfLegs(hand, SpectralArcLength), kNoLeg);
  values.Give("ldlj", part, MedianOfLegs(hand, LogDimensionlessJerk), kNoLeg);
}

// Share of the way from `a` to `b` that lies above `limit`, on the straight line between them.
double ShareAbove(double a, double b, double limit) {
  if (a > limit && b > limit) return 1;
  if (!(a > limit) && !(b > limit)) return 0;
  return (std::max(a, b) - limit) / std::abs(a - b);
}

void MeasureForce(const Hand& hand, const MetricLimits& limits, MetricCollector& values) {
  const std::string part = PartOf(hand.role);
  double peak = 0, sum = 0, touched = 0, over_time = 0;
  int over_count = 0;
  std::optional<double> last;  // force of the frame before; nothing after a break
  bool is_known = false;
  for (std::size_t k = 0; k < hand.frames.size(); ++k) {
    const ToolFrame& tool = hand.at(k);
    if (hand.frames[k].is_paused || !tool.is_valid) {
      last.reset();
      continue;
    }
    is_known = true;
    const double force = tool.mean_force;
    peak = std::max(peak, static_cast<double>(tool.peak_force));
    if (tool.contact != kNoContact) {
      sum += force;
      touched += static_cast<double>(tool.contact_share);
    }
    // Mean forces stand for the middles of their frames.
    if (last) over_time += kFrameTime * ShareAbove(*last, force, limits.harm);
    over_count += force > limits.harm && !(last && *last > limits.harm) ? 1 : 0;
    last = force;
  }
  constexpr std::string_view kWhy = "the hand was never known";
  const auto known = [&](double value) { return is_known ? std::optional(value) : std::nullopt; };
  values.Give("peak_force", part, known(peak), kWhy);
  values.Give("mean_force", part, touched > 0 ? std::optional(sum / touched) : std::nullopt,
              "the tool touched nothing");
  values.Give("over_time", part, known(over_time), kWhy);
  values.Give("over_count", part, known(over_count), kWhy);
}

void MeasureContacts(const Hand& hand, const std::vector<std::string>& surfaces,
                     MetricCollector& values) {
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const ContactSum sum = ContactsOf(hand, static_cast<int>(i));
    const std::string part = fmt::format("{} on {}", PartOf(hand.role), surfaces[i]);
    values.Give("contacts", part, sum.count);
    values.Give("contact_time", part, sum.time);
    values.Give("contact_path", part, sum.path);
    values.Give("contact_impulse", part, sum.impulse);
  }
}

}  // namespace

std::vector<MetricValue> MeasureAttempt(std::span<const AttemptFrame> frames,
                                        const std::vector<std::string>& surfaces,
                                        const MetricLimits& limits) {
  MetricCollector values;
  const double task_time = TaskTime(frames);
  values.Give("task_time", "both", task_time);
  std::array<Hand, 2> hands{
      Hand{frames, DeviceRole::kScope, HandPathsOf(frames, DeviceRole::kScope)},
      Hand{frames, DeviceRole::kInstrument, HandPathsOf(frames, DeviceRole::kInstrument)}};
  for (const Hand& hand : hands) {
    MeasureMotion(hand, task_time, values);
    MeasureForce(hand, limits, values);
    MeasureContacts(hand, surfaces, values);
  }
  const auto speeds = SpeedsOfBoth(hands, frames.size());
  constexpr std::string_view kNever = "the two tools were never in the joint together";
  const auto idle = std::count_if(speeds.begin(), speeds.end(), [](const auto& pair) {
    return pair[0] < kIdle && pair[1] < kIdle;
  });
  values.Give("idle_share", "both",
              speeds.empty()
                  ? std::nullopt
                  : std::optional(static_cast<double>(idle) / static_cast<double>(speeds.size())),
              kNever);
  values.Give("bimanual_r", "both", Correlation(speeds),
              speeds.empty() ? kNever : "one of the tools does not change its speed");
  return std::move(values).InOrder();
}

}  // namespace arthro::simulation
