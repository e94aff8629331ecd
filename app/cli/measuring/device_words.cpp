#include "app/cli/measuring/device_words.h"

#include <map>
#include <vector>

#include <fmt/format.h>

#include "simulation/core/units.h"

namespace arthro::app {
namespace {

using namespace simulation;
using Json = nlohmann::ordered_json;

const char* ToString(HandInput input) {
  return input == HandInput::kAbsolute ? "absolute" : input == HandInput::kRate ? "rate" : "none";
}
const char* ToString(Feedback feedback) {
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

Json JsonOf(const DeviceCaps& caps) {
  return {{"input", ToString(caps.input)},
          {"feedback", ToString(caps.feedback)},
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

Json JsonOf(const DeviceTrial& trial) {
  return {{"passed", trial.has_passed},     {"sentence", trial.sentence},
          {"seconds", trial.seconds},       {"rate", trial.rate},
          {"taken", trial.taken},           {"rejected", trial.rejected},
          {"full_rings", trial.full_rings}, {"written", trial.written},
          {"age_p50", trial.age_p50},       {"age_p99", trial.age_p99},
          {"spread", trial.spread}};
}

std::map<DeviceFamily, std::vector<std::string>> LookedFor() {
  std::map<DeviceFamily, std::vector<std::string>> numbers;
  for (const HidNumber& known : KnownNumbers())
    numbers[known.family].push_back(fmt::format("{:04x}:{:04x}", known.vendor, known.product));
  return numbers;
}

}  // namespace

ListedDevice ListedOf(const SurveyedDevice& own) {
  const HidNode& node = own.device.node;
  ListedDevice listed;
  listed.family = ToString(own.device.family);
  listed.name = Name(own.device.family);
  listed.number = fmt::format("{:04x}:{:04x}", node.vendor, node.product);
  listed.serial = node.serial;
  listed.path = node.path;
  listed.is_bluetooth = node.is_bluetooth;
  listed.can_be_used = own.can_be_used;
  listed.hands = own.hands;
  listed.caps = own.caps;
  listed.sentence = own.sentence;
  return listed;
}

ListedDevice ListedOf(OpenHapticsDevices& devices, std::size_t i, const std::string& configured) {
  const auto hand = devices.Hand(i);
  ListedDevice listed;
  listed.family = kOpenHapticsWord;
  listed.name = devices.is_open(i) ? fmt::format("{} (OpenHaptics)", hand->name()) : hand->name();
  listed.serial = configured;
  listed.path = configured.empty() ? "the setup tool's default" : "";
  if (!hand->serial().empty())
    listed.path += (listed.path.empty() ? "" : ", ") + ("maker's number " + hand->serial());
  listed.can_be_used = devices.is_open(i);
  listed.caps = hand->caps();
  listed.sentence = listed.can_be_used ? "is open" : devices.detail(i);
  return listed;
}

std::string HeadOf(const ListedDevice& own) {
  std::string text = own.name;
  if (!own.number.empty()) text += "  " + own.number;
  if (!own.number.empty() || !own.serial.empty())
    text += own.serial.empty() ? "  no serial number" : "  serial " + own.serial;
  return own.path.empty() ? text : text + "  " + own.path;
}

std::string TextOf(const ListedDevice& own, const std::optional<DeviceTrial>& trial) {
  std::string text = HeadOf(own) + "\n";
  if (own.caps.rate > 0) text += "  " + TextOf(own.caps, own.hands) + "\n";
  text += "  " + own.sentence + "\n";
  if (trial)
    text += fmt::format(
        "  self-test {}: {}\n  {:.0f} reports a second, {} rejected, {} written; samples {:.2f} ms "
        "old (median), {:.2f} ms (p99); hand moved {:.3f} mm\n",
        trial->has_passed ? "passed" : "failed", trial->sentence, trial->rate, trial->rejected,
        trial->written, 1e3 * trial->age_p50, 1e3 * trial->age_p99, MmFromMetres(trial->spread));
  return text;
}

Json JsonOf(const ListedDevice& own, const std::optional<DeviceTrial>& trial) {
  Json json{
      {"family", own.family},           {"name", own.name},         {"number", own.number},
      {"serial", own.serial},           {"path", own.path},         {"bluetooth", own.is_bluetooth},
      {"can_be_used", own.can_be_used}, {"sentence", own.sentence}, {"hands", own.hands},
      {"caps", JsonOf(own.caps)}};
  if (trial) json["self_test"] = JsonOf(*trial);
  return json;
}

Json LookedForJson() {
  Json looked_for = Json::array();
  for (const auto& [family, numbers] : LookedFor())
    looked_for.push_back(
        {{"family", ToString(family)}, {"name", Name(family)}, {"numbers", numbers}});
  return looked_for;
}

std::string Advice(int nodes, const std::string& openhaptics) {
  std::string text =
      fmt::format("No haptic device is plugged in. Among {} HID device{} these were looked for:\n",
                  nodes, nodes == 1 ? "" : "s");
  for (const auto& [family, numbers] : LookedFor()) {
    text += fmt::format("  {}: ", Name(family));
    for (std::size_t i = 0; i < numbers.size(); ++i) text += (i ? ", " : "") + numbers[i];
    text += "\n";
  }
  return text + fmt::format("  Touch and its kin: {}\n", openhaptics) +
         "Plug it in and run `arthroscene devices --watch`. If `lsusb` shows it and this does not, "
         "it does not\nspeak HID: a Falcon, Inverse3 or Omega does not. Practice works with mouse "
         "and keys without any.\n";
}

}  // namespace arthro::app
