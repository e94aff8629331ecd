// arthroscene devices: which haptic devices there are, whether they may be used, and what to do if
// not.
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/flags/number_flags.h"
#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/cli/measuring/device_words.h"
#include "app/cli/measuring/first_hour_job.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/device/live/device_survey.h"
#include "simulation/device/log/logged_device.h"

namespace arthro::app {
namespace {

using namespace simulation;

constexpr auto kWatchEvery = std::chrono::milliseconds(500);

struct DevicesArguments {
  std::string json, model, log, serial, record;
  std::vector<std::string> openhaptics;
  bool watches = false, tries = false, walks = false;
  double seconds = 0;
};

void Watch(HidBus& bus, const DevicesArguments& arguments) {
  const Progress progress = TerminalProgress();
  std::map<std::string, std::string> there;
  const double start = SteadySeconds();
  fmt::print("Watching; Ctrl-C ends it.\n");
  for (;;) {
    std::map<std::string, std::string> now;
    for (const SurveyedDevice& own : SurveyDevices(bus, arguments.model).devices)
      now[HeadOf(ListedOf(own))] = own.sentence;
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

// OpenHaptics devices. The library cannot list them, so these are the named ones or the default
// one, which need not exist.
struct Touches {
  std::vector<std::string> names;
  std::unique_ptr<OpenHapticsDevices> devices;  // null: built without
  std::string absent;                           // a sentence where none is listed
  std::vector<std::size_t> listed;
};

Touches FindTouches(const std::vector<std::string>& named) {
  Touches touches{named, {}, kNoOpenHaptics, {}};
  if (!HasOpenHaptics()) {
    if (!named.empty())
      throw Error(Code::kDevice,
                  fmt::format("--openhaptics {}: {}", named.front(), touches.absent));
    return touches;
  }
  if (named.empty()) touches.names.push_back("");
  touches.devices = std::make_unique<OpenHapticsDevices>(touches.names, SteadySeconds);
  touches.absent = touches.devices->detail(0);
  for (std::size_t i = 0; i < touches.names.size(); ++i)
    if (!named.empty() || touches.devices->is_open(i)) touches.listed.push_back(i);
  return touches;
}

// Lists them all, and tries those that can be used, in this order: HID devices, then the others.
class Lister {
 public:
  Lister(HidBus& bus, const DevicesArguments& arguments)
      : bus_(bus),
        arguments_(arguments),
        survey_(SurveyDevices(bus, arguments.model)),
        touches_(FindTouches(arguments.openhaptics)) {}

  void Run() {
    OpenLog();
    for (const SurveyedDevice& own : survey_.devices) Take(ListedOf(own), [&] { return Try(own); });
    for (const std::size_t i : touches_.listed)
      Take(ListedOf(*touches_.devices, i, touches_.names[i]), [&] { return Try(i); });
    CloseLog();
    Write();
  }

 private:
  static constexpr double kTrial = 2.0;  // s

  // A source each that is tried.
  void OpenLog() {
    std::vector<LogSource> sources;
    for (const SurveyedDevice& own : survey_.devices)
      if (own.can_be_used)
        sources.push_back(
            {ToString(own.device.family),
             own.device.family == DeviceFamily::kWoodenHaptics ? arguments_.model : "",
             own.device.node.serial,
             {}});
    for (const std::size_t i : touches_.listed)
      if (touches_.devices->is_open(i)) sources.push_back({"", "", touches_.names[i], {}});
    if (!arguments_.log.empty() && !sources.empty())
      log_ = std::make_unique<DeviceLog>(arguments_.log, sources);
  }

  double seconds() const { return arguments_.seconds > 0 ? arguments_.seconds : kTrial; }

  DeviceTrial Try(const SurveyedDevice& own) {
    std::optional<LoggedReports> reports;
    LiveOptions options;
    if (log_) options.tap = &reports.emplace(*log_, source_++);
    return TryDevice(bus_, {own.device.family, own.device.node.serial, arguments_.model}, seconds(),
                     options, progress_.stop);
  }

  // Its reports are the library's: what is logged is what each tick saw.
  DeviceTrial Try(std::size_t i) {
    std::unique_ptr<Device> hand = touches_.devices->Hand(i);
    if (log_) hand = std::make_unique<LoggedDevice>(std::move(hand), *log_, source_++);
    const auto counts = [&] {
      LinkCounts now;
      now.taken = now.written = touches_.devices->frames(i);
      return now;
    };
    return TryHand(*hand, {[&] { return touches_.devices->is_open(i); }, counts}, seconds(),
                   SteadySeconds, progress_.stop);
  }

  void Take(const ListedDevice& own, const std::function<DeviceTrial()>& attempt) {
    std::optional<DeviceTrial> trial;
    if (arguments_.tries && own.can_be_used) trial = attempt();
    failed_ += arguments_.tries && !(trial && trial->has_passed);
    devices_.push_back(JsonOf(own, trial));
    text_ += TextOf(own, trial);
  }

  void CloseLog() {
    if (!log_) return;
    log_->Close();
    if (const long dropped = log_->dropped(); dropped > 0)
      fmt::print(stderr, "warning: {}: {} records were dropped, since this machine was too busy\n",
                 arguments_.log, dropped);
  }

  void Write() const {
    if (!arguments_.json.empty()) {
      const nlohmann::ordered_json json{
          {"schema", "arthroscene.devices/1"},
          {"hid_devices", survey_.nodes},
          {"looked_for", LookedForJson()},
          {"openhaptics", {{"built", HasOpenHaptics()}, {"sentence", touches_.absent}}},
          {"devices", devices_}};
      WriteAtomically(arguments_.json, json.dump(2) + "\n");
    }
    if (arguments_.json != "-")
      fmt::print("{}", devices_.empty() ? Advice(survey_.nodes, touches_.absent) : text_);
    if (arguments_.tries && devices_.empty())
      throw Error(Code::kDevice, "there is no device to test; plug one in");
    if (failed_ > 0)
      throw Error(Code::kDevice,
                  fmt::format("{} of {} devices failed the self-test", failed_, devices_.size()));
  }

  HidBus& bus_;
  const DevicesArguments& arguments_;
  const Progress progress_ = TerminalProgress();
  DeviceSurvey survey_;
  std::unique_ptr<DeviceLog> log_;
  Touches touches_;
  int source_ = 0, failed_ = 0;
  nlohmann::ordered_json devices_ = nlohmann::ordered_json::array();
  std::string text_;
};

void Run(HidBus& bus, const DevicesArguments& arguments) {
  if (arguments.walks)
    WalkFirstHour(bus, {arguments.serial, arguments.record, arguments.model, arguments.openhaptics},
                  TerminalProgress());
  else if (arguments.watches)
    Watch(bus, arguments);
  else
    Lister(bus, arguments).Run();
}

// The walk of the first hour and what belongs to it.
void AddFirstHour(CLI::App& job, const std::shared_ptr<DevicesArguments>& own, JobFiles& files) {
  auto* walk = job.add_flag("--first-hour", own->walks,
                            "Walk through six steps with a new force device: zero force, "
                            "direction, scale, limit, loss, stop. The walk gives small forces.");
  for (const char* other : {"--watch", "--self-test", "--json"})
    walk->excludes(job.get_option(other));
  job.add_option("--serial", own->serial,
                 "Serial number of the device of the walk. Default: the only force device.")
      ->needs(walk);
  files
      .Output(
          job.add_option("--record", own->record, "Page of the walk's results, to print and sign."),
          {"a page of the first hour", FileForm::kUnique})
      ->needs(walk);
}

void CheckModel(const std::string& model) {
  if (model.empty() || FindWoodenModel(model) != nullptr) return;
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
      "devices", "List the haptic devices that are plugged in, and what prevents their use.");
  const auto own = std::make_shared<DevicesArguments>();
  auto* watch =
      job->add_flag("--watch", own->watches, "Report devices as they are plugged in and removed.");
  auto* tries = job->add_flag("--self-test", own->tries,
                              "Listen to each device for two seconds and report the rate and "
                              "quality of its samples. No force is given.");
  auto* names = job->add_option("--openhaptics", own->openhaptics,
                                "OpenHaptics device by the name in its maker's setup tool. "
                                "Default: the tool's default device.");
  const auto files = JobFiles::Of(*job);
  auto* json = files->Output(
      job->add_option("--json", own->json, "Write the list as JSON; - is standard output."),
      {"a list of devices", FileForm::kJson, "arthroscene.devices/"});
  watch->excludes(tries);
  watch->excludes(json);
  watch->excludes(names);
  files
      ->Output(job->add_option("--log", own->log,
                               "Log of each report of the self-test with its interpretation."),
               kLogFile)
      ->needs(tries);
  AddFirstHour(*job, own, *files);
  AddNumberOption(*job, "--seconds", {{0.1, 3600.0}, "s"},
                  "Time to watch, or to listen to each device.",
                  [own](double seconds) { own->seconds = seconds; });
  job->add_option(
      "--model", own->model,
      "Arm of a WoodenHaptics, which USB does not report: woodenhaptics_2015 or polhem_v1.");
  job->footer(
      "Serial numbers are what a rig file names its devices by. A device that may not be opened "
      "needs the rule 70-arthroscene.rules in /etc/udev/rules.d.");
  files->Run([own, files] {
    CheckModel(own->model);
    files->EmptyLog(own->log);
    const auto bus = MachineHidBus();
    Run(*bus, *own);
  });
}

}  // namespace arthro::app
