#include "simulation/device/hid/hid_node.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <tuple>

namespace arthro::simulation {
namespace {

using enum DeviceFamily;

struct FamilyWords {
  DeviceFamily family;
  const char *word, *name;  // in rig files, and for the user
};

constexpr FamilyWords kFamilyWords[] = {
    {kWoodenHaptics, "wooden_haptics", "WoodenHaptics or Polhem"},
    {kSpaceMouse, "space_mouse", "SpaceMouse"},
    {kHydra, "razer_hydra", "Razer Hydra"},
    {kDualSense, "dual_sense", "DualSense"},
    {kDualShock4, "dual_shock_4", "DualShock 4"}};

constexpr auto kFamilies = [] {
  std::array<DeviceFamily, std::size(kFamilyWords)> families{};
  std::transform(std::begin(kFamilyWords), std::end(kFamilyWords), families.begin(),
                 [](const FamilyWords& words) { return words.family; });
  return families;
}();

const FamilyWords& WordsOf(DeviceFamily family) {
  return *std::find_if(std::begin(kFamilyWords), std::end(kFamilyWords),
                       [=](const FamilyWords& words) { return words.family == family; });
}

constexpr std::uint16_t kLogitech = 0x046d, k3Dconnexion = 0x256f, kSony = 0x054c, kTeensy = 0x16c0;

constexpr HidNumber kNumbers[] = {
    {0x1234, 0x0006, kWoodenHaptics},    {kTeensy, 0x0486, kWoodenHaptics},
    {kLogitech, 0xc603, kSpaceMouse},    {kLogitech, 0xc605, kSpaceMouse},
    {kLogitech, 0xc606, kSpaceMouse},    {kLogitech, 0xc621, kSpaceMouse},
    {kLogitech, 0xc623, kSpaceMouse},    {kLogitech, 0xc625, kSpaceMouse},
    {kLogitech, 0xc626, kSpaceMouse},    {kLogitech, 0xc627, kSpaceMouse},
    {kLogitech, 0xc628, kSpaceMouse},    {kLogitech, 0xc629, kSpaceMouse},
    {kLogitech, 0xc62b, kSpaceMouse},    {k3Dconnexion, 0xc62e, kSpaceMouse},
    {k3Dconnexion, 0xc62f, kSpaceMouse}, {k3Dconnexion, 0xc631, kSpaceMouse},
    {k3Dconnexion, 0xc632, kSpaceMouse}, {k3Dconnexion, 0xc633, kSpaceMouse},
    {k3Dconnexion, 0xc635, kSpaceMouse}, {k3Dconnexion, 0xc636, kSpaceMouse},
    {k3Dconnexion, 0xc638, kSpaceMouse}, {k3Dconnexion, 0xc63a, kSpaceMouse},
    {k3Dconnexion, 0xc652, kSpaceMouse}, {0x1532, 0x0300, kHydra},
    {kSony, 0x0ce6, kDualSense},         {kSony, 0x0df2, kDualSense},
    {kSony, 0x05c4, kDualShock4},        {kSony, 0x09cc, kDualShock4},
};

constexpr std::uint16_t kDesktop = 0x01, kMultiAxis = 0x08, kGamepad = 0x05, kFirstVendor = 0xff00;

bool Holds(std::string_view text, std::string_view part) {
  return std::search(text.begin(), text.end(), part.begin(), part.end(), [](char a, char b) {
           return std::tolower(static_cast<unsigned char>(a)) ==
                  std::tolower(static_cast<unsigned char>(b));
         }) != text.end();
}

// Returns true for the part of a device that reports the hand.
bool IsHandOf(DeviceFamily family, const HidNode& node) {
  switch (family) {
    case kWoodenHaptics:
      // All Teensy boards with RawHID share these numbers.
      return node.vendor != kTeensy ||
             (node.usage_page >= kFirstVendor &&
              (Holds(node.product_name, "wooden") || Holds(node.product_name, "polhem") ||
               Holds(node.product_name, "haptik")));
    case kSpaceMouse:
      return node.usage_page == kDesktop && node.usage == kMultiAxis;
    case kHydra:
      return node.interface_number == 0;
    case kDualSense:
    case kDualShock4:
      return node.usage_page == kDesktop && node.usage == kGamepad;
  }
  return false;
}

}  // namespace

const char* ToString(DeviceFamily family) noexcept { return WordsOf(family).word; }
const char* Name(DeviceFamily family) noexcept { return WordsOf(family).name; }

std::optional<DeviceFamily> DeviceFamilyFromString(std::string_view word) noexcept {
  for (const FamilyWords& words : kFamilyWords)
    if (word == words.word) return words.family;
  return std::nullopt;
}

std::span<const DeviceFamily> AllFamilies() noexcept { return kFamilies; }
std::span<const HidNumber> KnownNumbers() noexcept { return kNumbers; }

std::optional<DeviceFamily> FamilyOf(const HidNode& node) noexcept {
  for (const HidNumber& known : kNumbers)
    if (known.vendor == node.vendor && known.product == node.product) {
      if (!IsHandOf(known.family, node)) return std::nullopt;
      return known.family;
    }
  return std::nullopt;
}

std::vector<KnownDevice> KnownAmong(std::span<const HidNode> nodes) {
  std::vector<KnownDevice> known;
  for (const HidNode& node : nodes) {
    const auto family = FamilyOf(node);
    // A node is listed once per usage.
    const auto is_same = [&](const KnownDevice& other) { return other.node.path == node.path; };
    if (family && std::none_of(known.begin(), known.end(), is_same))
      known.push_back({node, *family});
  }
  std::sort(known.begin(), known.end(), [](const KnownDevice& a, const KnownDevice& b) {
    return std::tie(a.family, a.node.serial, a.node.path) <
           std::tie(b.family, b.node.serial, b.node.path);
  });
  return known;
}

}  // namespace arthro::simulation
