#include "simulation/device/live/device_survey.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

constexpr auto kTick = std::chrono::milliseconds(1);
constexpr double kLongestOpening = 5.0;  // s; a Hydra may need three
constexpr double kLeastRate = 0.8, kMostRejected = 0.01;

std::string IdOf(const HidNode& node) {
  return node.serial.empty() ? std::filesystem::path(node.path).filename().string() : node.serial;
}

double Quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::string Verdict(const DeviceTrial& trial, const DeviceCaps& caps) {
  if (trial.full_rings > 0)
    return "reports were lost because this machine was too busy to read them; end other programs";
  if (static_cast<double>(trial.rejected) >
      kMostRejected * static_cast<double>(trial.taken + trial.rejected))
    return fmt::format(
        "{} of {} reports could not be understood; use another cable or port, and see that the "
        "model is right",
        trial.rejected, trial.taken + trial.rejected);
  if (!IsSteady(caps)) {
    return trial.taken > 0 ? "it speaks and is understood"
                           : "it is open; push it or press a button during the test to hear it";
  }
  if (trial.rate < kLeastRate * caps.rate)
    return fmt::format(
        "{:.0f} reports a second came where {:.0f} should; use another port, and no "
        "hub",
        trial.rate, caps.rate);
  return "it speaks at its rate and is understood";
}

}  // namespace

DeviceSurvey SurveyDevices(HidBus& bus, std::string_view model,
                           const std::filesystem::path& lock_folder) {
  DeviceSurvey survey;
  const auto nodes = bus.List();
  survey.nodes = static_cast<int>(nodes.size());
  for (const KnownDevice& device : KnownAmong(nodes)) {
    SurveyedDevice& own = survey.devices.emplace_back();
    own.device = device;
    const auto driver = MakeDriver(device, model, own.sentence);
    if (driver) {
      own.caps = driver->caps();
      own.hands = driver->hands();
    }
    const DeviceLock lock(lock_folder.empty() ? DeviceLockFolder() : lock_folder,
                          std::string(ToString(device.family)) + "-" + IdOf(device.node));
    if (lock.is_held_elsewhere()) {
      own.sentence = fmt::format("process {} uses it; close that program", lock.holder());
      continue;
    }
    OpenFault fault = OpenFault::kNone;
    const auto link = bus.Open(device.node, fault);
    if (!link) {
      own.sentence =
          DescribeStatus({DeviceState::kFault,
                          fault == OpenFault::kNoPermission ? DeviceTrouble::kNoPermission
                                                            : DeviceTrouble::kReadError,
                          true});
      continue;
    }
    own.can_be_used = driver != nullptr;
    if (driver) own.sentence = "may be opened";
  }
  return survey;
}

DeviceTrial TryHand(Device& device, const TriedDevice& tried, double seconds,
                    double (*clock)() noexcept, const std::atomic<bool>* stop) {
  DeviceTrial trial;
  const DeviceCaps& caps = device.caps();
  const LinkCounts before = tried.counts();
  const double start = SteadySeconds();
  std::vector<double> ages;
  ages.reserve(static_cast<std::size_t>(2000 * seconds));
  glm::dvec3 first(0.0);
  bool has_first = false;
  while (SteadySeconds() - start < seconds && !(stop && stop->load(std::memory_order_relaxed))) {
    const double now = clock();
    const DeviceSample sample = device.Read(now);
    device.HoldDeadMan(false);
    device.Command(glm::dvec3(0.0));
    if (sample.t > 0 && ages.size() < ages.capacity()) ages.push_back(now - sample.t);
    if (sample.valid) {
      if (!has_first) first = sample.hip_in_device;
      has_first = true;
      trial.spread = std::max(trial.spread, glm::distance(sample.hip_in_device, first));
    }
    std::this_thread::sleep_for(kTick);
  }
  trial.seconds = SteadySeconds() - start;
  const LinkCounts after = tried.counts();
  trial.taken = after.taken - before.taken;
  trial.rejected = after.rejected - before.rejected;
  trial.full_rings = after.full_rings - before.full_rings;
  trial.written = after.written - before.written;
  trial.rate = static_cast<double>(trial.taken) / trial.seconds;
  if (IsSteady(caps)) {
    trial.age_p50 = Quantile(ages, 0.5);
    trial.age_p99 = Quantile(ages, 0.99);
  }
  if (!tried.is_open()) {
    trial.sentence = "it was lost during the test; see to its cable";
    return trial;
  }
  trial.sentence = Verdict(trial, caps);
  trial.has_passed = trial.full_rings == 0 &&
                     static_cast<double>(trial.rejected) <=
                         kMostRejected * static_cast<double>(trial.taken + trial.rejected) &&
                     (!IsSteady(caps) || trial.rate >= kLeastRate * caps.rate);
  return trial;
}

DeviceTrial TryDevice(HidBus& bus, const DeviceRequest& request, double seconds,
                      const LiveOptions& options, const std::atomic<bool>* stop) {
  const auto link = std::make_shared<LiveLink>(bus, request, options);
  LiveDevice device(link, 0);
  const double begin = SteadySeconds();
  while (link->opening() == 0 && !(stop && stop->load(std::memory_order_relaxed))) {
    if (SteadySeconds() - begin > kLongestOpening) {
      device.Read(options.clock());
      device.Read(options.clock());
      DeviceTrial trial;
      trial.sentence = link->detail().empty() ? DescribeStatus(device.status()) : link->detail();
      return trial;
    }
    std::this_thread::sleep_for(kTick);
  }
  return TryHand(device, {[&] { return link->opening() != 0; }, [&] { return link->counts(); }},
                 seconds, options.clock, stop);
}

}  // namespace arthro::simulation
