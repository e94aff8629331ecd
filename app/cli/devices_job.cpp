// arthroscene devices: which haptic devices there are, whether they may be used, and what to do if
// not.
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/cli/output_check.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/device/live/device_survey.h"
#include "simulation/device/log/logged_device.h"

namespace arthro::app {
namespace {

using namespace simulation;

constexpr auto kWatchEvery = std::chrono::milliseconds(500);

struct DevicesArguments {
  std::string json, model, log;
  bool watches = false, tries = false;
  double seconds = 0;
};

std::string Number(const HidNode& node) {
  return fmt::format("{:04x}:{:04x}", node.vendor, node.product);
}

const char* Word(HandInput input) {
  return input == HandInput::kAbsolute ? "absolute" : input == HandInput::kRate ? "rate" : "none";
}
const char* Word(Feedback feedback) {
  return feedback == Feedback::kForce ? "force" : feedback == Feedback::kRumble ? "rumble" : "none";
}

std::string TextOf(const DeviceCaps& caps, int hands) {
  std::string text;
  if (caps.input == HandInput::kAbsolute)
    text = fmt::format("{} of {} degrees of freedom to {:.3f} mm at {:.0f} Hz",
                       hands == 1 ? "a hand" : "two hands", caps.sensed_dof,
                       MmFromMetres(caps.position_quantum), caps.rate);
  else if (caps.input == HandInput::kRate)
    text = "a hand led by pushing and turning";
  else
    text = "no hand";
  if (HasForce(caps))
    text += fmt::format(", force to {:g} N ({:.2g} N for long) and {:g} N/m", caps.peak_force,
                        caps.continuous_force, caps.max_stiffness);
  else
    text += caps.feedback == Feedback::kRumble ? ", rumbles" : ", no force";
  return text + fmt::format(", {} button{}", caps.buttons, caps.buttons == 1 ? "" : "s");
}

std::string NameOf(const SurveyedDevice& own) {
  const HidNode& node = own.device.node;
  return fmt::format("{}  {}  {}  {}", Name(own.device.family), Number(node),
                     node.serial.empty() ? "no serial number" : "serial " + node.serial, node.path);
}

nlohmann::ordered_json JsonOf(const DeviceCaps& caps) {
  return {{"input", Word(caps.input)},
          {"feedback", Word(caps.feedback)},
          {"sensed_dof", caps.sensed_dof},
          {"actuated_dof", caps.actuated_dof},
          {"position_quantum", caps.position_quantum},
          {"gimbal_sigma_deg", DegreesFromRadians(caps.gimbal_sigma)},
          {"peak_force", caps.peak_force},
          {"continuous_force", caps.continuous_force},
          {"max_stiffness", caps.max_stiffness},
          {"damping", caps.damping},
          {"rate", caps.rate},
          {"delay_ticks", caps.delay_ticks},
          {"buttons", caps.buttons},
          {"watchdog", caps.watchdog}};
}

nlohmann::ordered_json JsonOf(const DeviceTrial& trial) {
  return {{"passed", trial.has_passed},     {"sentence", trial.sentence},
          {"seconds", trial.seconds},       {"rate", trial.rate},
          {"taken", trial.taken},           {"rejected", trial.rejected},
          {"full_rings", trial.full_rings}, {"written", trial.written},
          {"age_p50", trial.age_p50},       {"age_p99", trial.age_p99},
          {"spread", trial.spread}};
}

nlohmann::ordered_json JsonOf(const SurveyedDevice& own, const std::optional<DeviceTrial>& trial) {
  const HidNode& node = own.device.node;
  nlohmann::ordered_json json{{"family", Word(own.device.family)},
                              {"name", Name(own.device.family)},
                              {"number", Number(node)},
                              {"serial", node.serial},
                              {"path", node.path},
                              {"bluetooth", node.is_bluetooth},
                              {"can_be_used", own.can_be_used},
                              {"sentence", own.sentence},
                              {"hands", own.hands},
                              {"caps", JsonOf(own.caps)}};
  if (trial) json["self_test"] = JsonOf(*trial);
  return json;
}

std::map<DeviceFamily, std::vector<std::string>> LookedFor() {
  std::map<DeviceFamily, std::vector<std::string>> numbers;
  for (const HidNumber& known : KnownNumbers())
    numbers[known.family].push_back(fmt::format("{:04x}:{:04x}", known.vendor, known.product));
  return numbers;
}

// What to do on a machine that has none.
std::string Advice(int nodes) {
  std::string text =
      fmt::format("No haptic device is plugged in. Among {} HID device{} these were looked for:\n",
                  nodes, nodes == 1 ? "" : "s");
  for (const auto& [family, numbers] : LookedFor()) {
    text += fmt::format("  {}: ", Name(family));
    for (std::size_t i = 0; i < numbers.size(); ++i) text += (i ? ", " : "") + numbers[i];
    text += "\n";
  }
  return text +
         "Plug it in and run `arthroscene devices --watch`. If `lsusb` shows it and this does not, "
         "it does not\nspeak HID: a Touch, Falcon, Inverse3 or Omega does not. Practice works with "
         "mouse and keys without any.\n";
}

// Those that are tried, in their order.
std::vector<LogSource> SourcesOf(const DeviceSurvey& survey, const std::string& model) {
  std::vector<LogSource> sources;
  for (const SurveyedDevice& own : survey.devices)
    if (own.can_be_used)
      sources.push_back({Word(own.device.family),
                         own.device.family == DeviceFamily::kWoodenHaptics ? model : "",
                         own.device.node.serial,
                         {}});
  return sources;
}

void Watch(HidBus& bus, const DevicesArguments& arguments) {
  const Progress progress = TerminalProgress();
  std::map<std::string, std::string> there;
  const double start = SteadySeconds();
  fmt::print("Watching; Ctrl-C ends it.\n");
  for (;;) {
    std::map<std::string, std::string> now;
    for (const SurveyedDevice& own : SurveyDevices(bus, arguments.model).devices)
      now[NameOf(own)] = own.sentence;
    for (const auto& [name, sentence] : now)
      if (const auto was = there.find(name); was == there.end() || was->second != sentence)
        fmt::print("+ {}: {}\n", name, sentence);
    for (const auto& [name, sentence] : there)
      if (!now.contains(name)) fmt::print("- {}\n", name);
    std::fflush(stdout);
    there = std::move(now);
    const bool is_over = arguments.seconds > 0 && SteadySeconds() - start >= arguments.seconds;
    if (progress.ShouldStop() || is_over) return;
    std::this_thread::sleep_for(kWatchEvery);
  }
}

void List(HidBus& bus, const DevicesArguments& arguments) {
  constexpr double kTrial = 2.0;  // s
  const Progress progress = TerminalProgress();
  CheckOutputs({arguments.json, arguments.log}, {});
  const DeviceSurvey survey = SurveyDevices(bus, arguments.model);
  std::unique_ptr<DeviceLog> log;
  const auto sources = SourcesOf(survey, arguments.model);
  if (!arguments.log.empty() && !sources.empty())
    log = std::make_unique<DeviceLog>(arguments.log, sources);
  int source = 0;
  nlohmann::ordered_json devices = nlohmann::ordered_json::array();
  std::string text;
  int failed = 0;
  for (const SurveyedDevice& own : survey.devices) {
    std::optional<DeviceTrial> trial;
    if (arguments.tries && own.can_be_used) {
      std::optional<LoggedReports> reports;
      LiveOptions options;
      if (log) options.tap = &reports.emplace(*log, source++);
      trial = TryDevice(bus, {own.device.family, own.device.node.serial, arguments.model},
                        arguments.seconds > 0 ? arguments.seconds : kTrial, options, progress.stop);
    }
    failed += arguments.tries && !(trial && trial->has_passed);
    devices.push_back(JsonOf(own, trial));
    text += NameOf(own) + "\n";
    if (own.caps.rate > 0) text += "  " + TextOf(own.caps, own.hands) + "\n";
    text += "  " + own.sentence + "\n";
    if (trial)
      text += fmt::format(
          "  self-test {}: {}\n  {:.0f} reports a second, {} rejected, {} written; samples {:.2f} "
          "ms "
          "old (median), {:.2f} ms (p99); hand moved {:.3f} mm\n",
          trial->has_passed ? "passed" : "failed", trial->sentence, trial->rate, trial->rejected,
          trial->written, 1e3 * trial->age_p50, 1e3 * trial->age_p99, MmFromMetres(trial->spread));
  }
  if (log) {
    log->Close();
    if (const long dropped = log->dropped(); dropped > 0)
      fmt::print(stderr, "warning: {}: {} records were dropped, since this machine was too busy\n",
                 arguments.log, dropped);
  }
  if (!arguments.json.empty()) {
    nlohmann::ordered_json looked_for = nlohmann::ordered_json::array();
    for (const auto& [family, numbers] : LookedFor())
      looked_for.push_back(
          {{"family", Word(family)}, {"name", Name(family)}, {"numbers", numbers}});
    const nlohmann::ordered_json json{{"schema", "arthroscene.devices/1"},
                                      {"hid_devices", survey.nodes},
                                      {"looked_for", looked_for},
                                      {"devices", devices}};
    WriteAtomically(arguments.json, json.dump(2) + "\n");
  }
  if (arguments.json != "-") fmt::print("{}", survey.devices.empty() ? Advice(survey.nodes) : text);
  if (arguments.tries && survey.devices.empty())
    throw Error(Code::kDevice, "there is no device to test; plug one in");
  if (failed > 0)
    throw Error(Code::kDevice, fmt::format("{} of {} devices failed the self-test", failed,
                                           survey.devices.size()));
}

void CheckModel(const std::string& model) {
  if (model.empty() || WoodenModelNamed(model) != nullptr) return;
  const std::string why =
      IsSecretWoodenModel(model)
          ? fmt::format("the kinematics of {} are not published, so it is not driven", model)
          : fmt::format("there is no arm \"{}\"", model);
  throw Error(Code::kBadArgument,
              fmt::format("--model: {}; the models are {}", why, WoodenModelWords()));
}

}  // namespace

void AddDevicesJob(CLI::App& program) {
  CLI::App* job = program.add_subcommand(
      "devices", "List the haptic devices that are plugged in, and what is in their way");
  const auto own = std::make_shared<DevicesArguments>();
  auto* watch = job->add_flag("--watch", own->watches, "Say what is plugged in and pulled out");
  auto* tries = job->add_flag(
      "--self-test", own->tries,
      "Listen to each for two seconds and say how fast and how well it speaks; gives no force");
  auto* json = job->add_option("--json", own->json, "Write the list as JSON; - is standard output");
  watch->excludes(tries);
  watch->excludes(json);
  job->add_option("--log", own->log,
                  "Write each report of the self-test, and what was made of it, to this file")
      ->needs(tries);
  job->add_option("--seconds", own->seconds, "How long to watch, or to listen to each device")
      ->check(CLI::Range(0.1, 3600.0));
  job->add_option(
      "--model", own->model,
      "Arm of a WoodenHaptics, which its USB numbers do not tell: woodenhaptics_2015 or "
      "polhem_v1");
  job->footer(
      "Serial numbers are what a rig file names its devices by. A device that may not be opened "
      "needs the rule 70-arthroscene.rules in /etc/udev/rules.d.");
  job->callback([own] {
    CheckModel(own->model);
    const auto bus = MachineHidBus();
    own->watches ? Watch(*bus, *own) : List(*bus, *own);
  });
}

}  // namespace arthro::app
