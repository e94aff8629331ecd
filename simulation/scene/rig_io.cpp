#include "simulation/scene/rig_io.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"
#include "simulation/scene/field_json.h"

namespace arthro {
namespace {

using Reader = JsonObjectReader;

constexpr const char* kSchema = "arthroscene.rig/1";
constexpr const char *kWooden = "wooden_haptics", *kHydra = "razer_hydra",
                     *kOpenHaptics = "openhaptics";
// m; a shorter rod does not reach a joint through its incision, a longer one is no instrument.
constexpr JsonLimits kRod{0.05, 0.6, "metres"};
constexpr JsonLimits kForce{0, 20, "N", true}, kStiffness{0, 10000, "N/m", true};
constexpr int kButtons = 32;

// A whole number, since the reader of objects knows numbers only.
void Whole(Reader& reader, const char* name, int& field, int max) {
  double number = field;
  reader.Number(name, number, {0, static_cast<double>(max)});
  field = static_cast<int>(number);
  if (field != number) reader.Fault(name, "must be a whole number");
}

void ReadDevice(Reader& owner, RigDevice& device, bool needs_hand) {
  owner.Object("device", Reader::kRequired, [&](Reader& reader) {
    reader.Text("family", device.family, Reader::kRequired);
    reader.Text("serial", device.serial);
    reader.Text("model", device.model);
    Whole(reader, "hand", device.hand, 1);
    reader.RefuseOtherKeys();
    std::string words;
    bool is_known = false;
    for (const char* word : RigFamilies()) {
      words += (words.empty() ? "" : ", ") + std::string(word);
      is_known = is_known || device.family == word;
    }
    if (!is_known) {
      if (!device.family.empty())
        reader.Fault("family", fmt::format("is \"{}\"; the families are {}", device.family, words));
      return;
    }
    if (needs_hand && !IsHandFamily(device.family))
      reader.Fault("family", fmt::format("is \"{}\", which does not know where a hand is; it may "
                                         "be the pedals",
                                         device.family));
    if (!needs_hand && device.family == kOpenHaptics)
      reader.Fault("family", fmt::format("is \"{}\", which may hold a hand and is no pedal; bind "
                                         "its buttons there",
                                         device.family));
    if (device.hand > 0 && device.family != kHydra)
      reader.Fault("hand",
                   fmt::format("is {}, and a {} has one hand, 0", device.hand, device.family));
    if (device.family == kWooden && device.model.empty())
      reader.Fault("model",
                   "is missing; a wrong arm pushes the wrong way, so name it: "
                   "woodenhaptics_2015 or polhem_v1");
    if (device.model == "polhem_v2" || device.model == "polhem_v3")
      reader.Fault("model", fmt::format("is \"{}\", whose kinematics are not published; it cannot "
                                        "be driven",
                                        device.model));
  });
}

void ReadButtons(Reader& owner, RigButtons& buttons) {
  owner.Object("buttons", Reader::kOptional, [&](Reader& reader) {
    for (int i = 0; i < kRigActions; ++i) {
      const char* name = Word(static_cast<RigAction>(i));
      if (!reader.Has(name)) continue;
      int button = 0;
      Whole(reader, name, button, kButtons - 1);
      for (int other = 0; other < i; ++other)
        if (buttons[static_cast<std::size_t>(other)] == button)
          reader.Fault(name, fmt::format("is button {}, as {} is; give each its own", button,
                                         Word(static_cast<RigAction>(other))));
      buttons[static_cast<std::size_t>(i)] = button;
    }
    for (int i = 0; i < kRigActions; ++i) reader.Know(Word(static_cast<RigAction>(i)));
    reader.RefuseOtherKeys();
  });
}

void ReadRole(Reader& rig, const char* name, std::optional<RigRole>& role) {
  rig.Object(name, Reader::kOptional, [&](Reader& reader) {
    RigRole& own = role.emplace();
    ReadDevice(reader, own.device, true);
    reader.Number("rod_length", own.mount.rod_length, kRod, Reader::kRequired);
    reader.Point("pivot", own.mount.pivot, LimitsInFile(kCoordinate, "m"));
    reader.Quaternion("portal_from_device", own.mount.portal_from_device);
    double to_incision = 0;
    reader.Number("hand_to_incision", to_incision, LimitsInFile(kLength, "m"));
    reader.Number("max_force", own.max_force, kForce);
    reader.Number("max_stiffness", own.max_stiffness, kStiffness);
    ReadButtons(reader, own.buttons);
    reader.RefuseOtherKeys();
    if (to_incision >= own.mount.rod_length)
      reader.Fault("hand_to_incision",
                   fmt::format("is {} m and the rod {} m, so its tip would not reach the incision; "
                               "were the two lengths swapped?",
                               to_incision, own.mount.rod_length));
  });
}

bool IsSame(const RigDevice& a, const RigDevice& b) {
  return a.family == b.family && a.serial == b.serial && a.hand == b.hand;
}

void CheckTogether(const RigFile& rig, Reader& reader) {
  if (!rig.scope && !rig.instrument) {
    reader.Fault("scope", "and instrument are both missing; a rig has at least one device");
    return;
  }
  if (!rig.scope || !rig.instrument) return;
  const RigDevice &scope = rig.scope->device, &instrument = rig.instrument->device;
  if (scope.family != instrument.family) return;
  const bool is_one_of_two_hands = scope.family == kHydra && scope.serial == instrument.serial;
  if (IsSame(scope, instrument))
    reader.Fault(
        "instrument.device",
        fmt::format("is the scope's; two {} are told apart by serial, which {}{}", scope.family,
                    scope.family == kOpenHaptics ? "is the name in the maker's setup tool"
                                                 : "`arthroscene devices` lists",
                    scope.family == kHydra ? ", or by hand" : ""));
  else if (!is_one_of_two_hands && (scope.serial.empty() || instrument.serial.empty()))
    reader.Fault("instrument.device",
                 "and the scope's are of one family; give both a serial, or the roles would change "
                 "with the ports");
}

}  // namespace

RigFile ParseRig(const std::string& text, const std::filesystem::path& file) {
  const nlohmann::json json = ParseJson(text, Code::kBadData, file);
  if (!json.is_object())
    throw Error(Code::kBadData, "a rig must be a JSON object {…}; mend or remove it", file);
  std::vector<JsonFault> faults;
  Reader reader(json, "", faults);
  RigFile rig;
  std::string schema;
  reader.Text("schema", schema, Reader::kRequired);
  if (schema != kSchema && !schema.empty())
    throw Error(Code::kBadData,
                fmt::format("its schema is \"{}\"; this program reads \"{}\"", schema, kSchema),
                file);
  reader.Text("title", rig.title, Reader::kRequired);
  ReadRole(reader, "scope", rig.scope);
  ReadRole(reader, "instrument", rig.instrument);
  reader.Object("pedals", Reader::kOptional, [&](Reader& inner) {
    RigPedals& pedals = rig.pedals.emplace();
    ReadDevice(inner, pedals.device, false);
    ReadButtons(inner, pedals.buttons);
    inner.RefuseOtherKeys();
  });
  reader.RefuseOtherKeys(true);
  if (faults.empty()) CheckTogether(rig, reader);
  if (!faults.empty()) throw Error(Code::kBadData, faults.front().sentence, file);
  return rig;
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
