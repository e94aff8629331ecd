#include "simulation/scene/json/rig_io.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"
#include "simulation/scene/json/field_json.h"
#include "simulation/scene/json/field_schema.h"
#include "simulation/scene/json/scene_json.h"

namespace arthro {
namespace {

constexpr const char* kRigSchema = "arthroscene.rig/1";
constexpr const char *kWooden = "wooden_haptics", *kHydra = "razer_hydra",
                     *kOpenHaptics = "openhaptics";

// Collects what is wrong with a rig beyond the fields: with keys from the root.
class RigCheck {
 public:
  explicit RigCheck(std::vector<JsonFault>& faults) : faults_(faults) {}

  void Device(const std::string& owner, const RigDevice& device, bool needs_hand) {
    const std::string key = owner + ".device.";
    const std::string& family = device.family;
    if (needs_hand && !IsHandFamily(family))
      Fault(key + "family",
            fmt::format("is \"{}\", which does not know where a hand is; it may be the pedals",
                        family));
    if (!needs_hand && family == kOpenHaptics)
      Fault(key + "family",
            fmt::format("is \"{}\", which may hold a hand and is no pedal; bind its buttons there",
                        family));
    if (device.hand > 0 && family != kHydra)
      Fault(key + "hand", fmt::format("is {}, and a {} has one hand, 0", device.hand, family));
    if (family == kWooden && device.model.empty())
      Fault(key + "model", fmt::format("is missing; a wrong arm pushes the wrong way, so name it: "
                                       "{}",
                                       fmt::join(RigModels(), " or ")));
  }

  void Buttons(const std::string& owner, const RigButtons& buttons) {
    for (std::size_t i = 0; i < buttons.size(); ++i)
      for (std::size_t other = 0; other < i; ++other)
        if (buttons[i] >= 0 && buttons[other] == buttons[i])
          Fault(owner + ".buttons." + Word(static_cast<RigAction>(i)),
                fmt::format("is button {}, as {} is; give each its own", buttons[i],
                            Word(static_cast<RigAction>(other))));
  }

  void Role(const std::string& name, const RigRole& role) {
    Device(name, role.device, true);
    Buttons(name, role.buttons);
    if (role.hand_to_incision >= role.mount.rod_length)
      Fault(name + ".hand_to_incision",
            fmt::format("is {} m and the rod {} m, so its tip would not reach the incision; were "
                        "the two lengths swapped?",
                        role.hand_to_incision, role.mount.rod_length));
    TipOffsets offsets = role.tip_offsets;
    offsets.Visit([&](const char* kind, double beyond, const auto&, const char*, const char*) {
      Tip(name, role, kind, beyond);
    });
  }

  void Together(const RigFile& rig);

 private:
  void Tip(const std::string& owner, const RigRole& role, const char* kind, double beyond) {
    if (beyond == 0) return;
    const std::string key = fmt::format("{}.tip_offsets.{}", owner, kind);
    const double length = role.mount.rod_length + beyond;
    if (owner == "scope")
      Fault(key, "belongs to an instrument; move tip_offsets to instrument");
    else if (length < kRodRange.min || length > kRodRange.max)
      Fault(key, fmt::format("makes the rod {:.4g} m long; with its tip it must be {} to {} m",
                             length, kRodRange.min, kRodRange.max));
    else if (role.hand_to_incision >= length)
      Fault(key, fmt::format("makes the rod {:.4g} m long, so its tip would not reach the incision "
                             "{:.4g} m from the hand",
                             length, role.hand_to_incision));
  }
  void Fault(const std::string& key, const std::string& sentence) {
    faults_.push_back({key, key + " " + sentence});
  }
  std::vector<JsonFault>& faults_;
};

bool IsSame(const RigDevice& a, const RigDevice& b) {
  return a.family == b.family && a.serial == b.serial && a.hand == b.hand;
}

void RigCheck::Together(const RigFile& rig) {
  if (!rig.scope && !rig.instrument) {
    Fault("scope", "and instrument are both missing; a rig has at least one device");
    return;
  }
  if (!rig.scope || !rig.instrument) return;
  const RigDevice &scope = rig.scope->device, &instrument = rig.instrument->device;
  if (scope.family != instrument.family) return;
  const bool is_one_of_two_hands = scope.family == kHydra && scope.serial == instrument.serial;
  if (IsSame(scope, instrument))
    Fault("instrument.device",
          fmt::format("is the scope's; two {} are told apart by serial, which {}{}", scope.family,
                      scope.family == kOpenHaptics ? "is the name in the maker's setup tool"
                                                   : "`arthroscene devices` lists",
                      scope.family == kHydra ? ", or by hand" : ""));
  else if (!is_one_of_two_hands && (scope.serial.empty() || instrument.serial.empty()))
    Fault("instrument.device",
          "and the scope's are of one family; give both a serial, or the roles would change "
          "with the ports");
}

}  // namespace

RigFile ParseRig(const std::string& text, const std::filesystem::path& file) {
  const nlohmann::json json = ParseJson(text, Code::kBadData, file);
  if (!json.is_object())
    throw Error(Code::kBadData, "a rig must be a JSON object {…}; mend or remove it", file);
  std::vector<JsonFault> faults;
  JsonObjectReader reader(json, "", faults);
  RigFile rig;
  std::string schema;
  reader.Text("schema", schema, JsonObjectReader::kRequired);
  if (schema != kRigSchema && !schema.empty())
    throw Error(Code::kBadData,
                fmt::format("its schema is \"{}\"; this program reads \"{}\"", schema, kRigSchema),
                file);
  rig.Visit(FieldReader(reader));
  reader.RefuseOtherKeys(true);
  if (faults.empty()) {
    RigCheck check(faults);
    if (rig.scope) check.Role("scope", *rig.scope);
    if (rig.instrument) check.Role("instrument", *rig.instrument);
    if (rig.pedals) {
      check.Device("pedals", rig.pedals->device, false);
      check.Buttons("pedals", rig.pedals->buttons);
    }
    check.Together(rig);
  }
  if (!faults.empty()) throw Error(Code::kBadData, faults.front().sentence, file);
  return rig;
}

std::string RigSchemaText() {
  auto json = FileSchema(
      kRigSchema, "Arthroscene rig, version 1",
      "Which device holds the scope and which the instrument, and how each is mounted on its "
      "incision. SI units, device frame. Roles follow serial numbers, as `arthroscene devices` "
      "lists them. This schema cannot express six rules. A hand_to_incision is shorter than its "
      "rod. Only the instrument has tip_offsets, and its rod with each has the length of a rod. "
      "Two devices of one family both need a serial. Pads hold no hand. An openhaptics is no "
      "pedal. Numbers of buttons differ.",
      SchemaOfFields(RigFile()));
  json["anyOf"] = {{{"required", {"scope"}}}, {{"required", {"instrument"}}}};
  json["definitions"]["quaternion"] = FieldDefinitions()["quaternion"];
  return PrettyJson(json);
}

std::string RigText(const RigFile& rig) {
  nlohmann::ordered_json json;
  json["schema"] = kRigSchema;
  RigFile copy = rig;
  copy.Visit(FieldWriter(json));
  std::string text = PrettyJson(json);
  ParseRig(text);
  return text;
}

void WriteRig(const std::filesystem::path& file, const RigFile& rig) {
  WriteAtomically(file, RigText(rig));
}

RigFile ReadRig(const std::filesystem::path& file) {
  return ParseRig(ReadWholeFile(file, kMostJsonBytes), file);
}

std::string RigTextWith(const RigPivots& pivots, const std::string& text,
                        const std::filesystem::path& file) {
  ParseRig(text, file);
  auto json = ParseOrderedJson(text, Code::kBadData, file);
  const auto put = [&](const char* role, const std::optional<glm::dvec3>& pivot) {
    if (!pivot) return;
    if (!json.contains(role))
      throw Error(Code::kBadData, fmt::format("{} is missing, so its pivot has no place", role),
                  file);
    json[role]["pivot"] = {pivot->x, pivot->y, pivot->z};
  };
  put("scope", pivots.scope);
  put("instrument", pivots.instrument);
  std::string with = json.dump(2) + "\n";
  ParseRig(with, file);  // a pivot that cannot be read again is not written
  return with;
}

void WriteRigWith(const RigPivots& pivots, const std::filesystem::path& from,
                  const std::filesystem::path& to) {
  WriteAtomically(to, RigTextWith(pivots, ReadWholeFile(from, kMostJsonBytes), from));
}

}  // namespace arthro
