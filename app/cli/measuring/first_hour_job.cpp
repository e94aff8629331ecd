#include "app/cli/measuring/first_hour_job.h"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <optional>
#include <poll.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

#include "app/about/about.h"
#include "app/cli/measuring/first_hour.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/device/live/device_survey.h"
#include "simulation/device/openhaptics/openhaptics_devices.h"

namespace arthro::app {
namespace {

using namespace simulation;

constexpr auto kTick = std::chrono::milliseconds(1);
constexpr double kLongestOpening = 5.0;  // s
constexpr int kPollMs = 100;

// A line of standard input; nullopt at its end, or where the program is to end.
std::optional<std::string> ReadLine(const Progress& progress) {
  std::string line;
  for (char letter = 0; !progress.ShouldStop();) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (const int ready = ::poll(&input, 1, kPollMs); ready == 0 || (ready < 0 && errno == EINTR))
      continue;
    const auto got = ::read(STDIN_FILENO, &letter, 1);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return std::nullopt;
    if (letter == '\n') return line;
    if (letter != '\r') line += letter;
  }
  return std::nullopt;
}

Person PersonAtTerminal(const Progress& progress) {
  return {[](const std::string& line) {
            fmt::print("{}\n", line);
            std::fflush(stdout);
          },
          [&progress](const std::string& question) {
            fmt::print("{}", question);
            std::fflush(stdout);
            return ReadLine(progress).value_or("stop");
          }};
}

std::string Today() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  char words[16];
  std::strftime(words, sizeof words, "%Y-%m-%d", &local);
  return words;
}

void Walk(Device& device, const std::string& record, const Progress& progress) {
  const HourTicks ticks{[] {
                          std::this_thread::sleep_for(kTick);
                          return SteadySeconds();
                        },
                        [&progress] { return progress.ShouldStop(); }};
  const std::vector<HourRow> rows = TakeFirstHour(device, ticks, PersonAtTerminal(progress));
  const std::string text =
      RecordText(rows, device, Today(), fmt::format("Arthroscene {}", Version()));
  fmt::print("\n{}", text);
  if (!record.empty()) WriteAtomically(record, text);
  if (!HasPassed(rows))
    throw Error(Code::kDevice, "not all six steps passed; give no forces with this device");
}

// One device with a force, and what runs it.
struct ForceDevice {
  std::string name, serial;
  std::function<void()> walk;
};

void WalkLive(HidBus& bus, const DeviceRequest& request, const std::string& record,
              const Progress& progress) {
  const auto link = std::make_shared<LiveLink>(bus, request, LiveOptions());
  LiveDevice device(link, 0);
  const double begin = SteadySeconds();
  while (link->opening() == 0) {
    if (progress.ShouldStop() || SteadySeconds() - begin > kLongestOpening) {
      device.Read(SteadySeconds());
      throw Error(Code::kDevice,
                  link->detail().empty() ? DescribeStatus(device.status()) : link->detail());
    }
    std::this_thread::sleep_for(kTick);
  }
  Walk(device, record, progress);
}

ForceDevice Choose(std::vector<ForceDevice> devices, const std::string& serial) {
  if (!serial.empty())
    std::erase_if(devices, [&](const ForceDevice& own) { return own.serial != serial; });
  if (devices.size() == 1) return devices.front();
  if (devices.empty())
    throw Error(Code::kDevice,
                serial.empty()
                    ? "there is no force device that can be used; `arthroscene devices` says why"
                    : fmt::format("--serial {}: no force device of this serial number can be "
                                  "used; `arthroscene devices` lists them",
                                  serial));
  throw Error(Code::kDevice,
              fmt::format("there are {} force devices; name one with --serial", devices.size()));
}

}  // namespace

void WalkFirstHour(HidBus& bus, const FirstHourArguments& arguments, const Progress& progress) {
  if (!HasOpenHaptics() && !arguments.openhaptics.empty())
    throw Error(Code::kDevice,
                fmt::format("--openhaptics {}: {}", arguments.openhaptics.front(), kNoOpenHaptics));
  std::vector<ForceDevice> devices;
  for (const SurveyedDevice& own : SurveyDevices(bus, arguments.model).devices)
    if (own.can_be_used && HasForce(own.caps))
      devices.push_back({Name(own.device.family), own.device.node.serial, [&, own] {
                           WalkLive(bus,
                                    {own.device.family, own.device.node.serial, arguments.model},
                                    arguments.record, progress);
                         }});
  std::vector<std::string> names = arguments.openhaptics;
  if (names.empty()) names.push_back("");
  std::optional<OpenHapticsDevices> touches;
  if (HasOpenHaptics()) touches.emplace(names, SteadySeconds);
  for (std::size_t i = 0; touches && i < names.size(); ++i)
    if (touches->is_open(i))
      devices.push_back({kOpenHapticsName, names[i], [&, i] {
                           const auto device = touches->Hand(i);
                           Walk(*device, arguments.record, progress);
                         }});
  Choose(std::move(devices), arguments.serial).walk();
}

}  // namespace arthro::app
