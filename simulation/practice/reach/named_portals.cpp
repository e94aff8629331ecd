#include "simulation/practice/reach/named_portals.h"

#include <array>
#include <cmath>

namespace arthro::simulation {
namespace {

constexpr double kTendon = 0.030;     // m, width of the patellar tendon
constexpr double kAccessory = 0.020;  // m, from a portal to the accessory one beyond it

constexpr std::array<NamedPortals, 6> kPortals = {
    {{"anterolateral-anteromedial", "Anterolateral, anteromedial", kTendon},
     {"anteromedial-anterolateral", "Anteromedial, anterolateral", -kTendon},
     {"anterolateral-central", "Anterolateral, transtendinous", 0.5 * kTendon},
     {"anteromedial-central", "Anteromedial, transtendinous", -0.5 * kTendon},
     {"anterolateral-accessory-medial", "Anterolateral, accessory medial", kTendon + kAccessory},
     {"anteromedial-accessory-medial", "Anteromedial, accessory medial", kAccessory}}};

}  // namespace

std::span<const NamedPortals> EveryNamedPortals() { return kPortals; }

const NamedPortals* FindNamedPortals(std::string_view word) {
  for (const NamedPortals& portals : kPortals)
    if (word == portals.word) return &portals;
  return nullptr;
}

double SpacingOf(const NamedPortals& portals, bool is_left_knee) {
  return is_left_knee ? -portals.medially : portals.medially;
}

std::optional<int> NamedPortalsAt(double spacing, bool is_left_knee) {
  constexpr double kSame = 1e-4;  // m
  for (std::size_t i = 0; i < kPortals.size(); ++i)
    if (std::abs(SpacingOf(kPortals[i], is_left_knee) - spacing) < kSame)
      return static_cast<int>(i);
  return std::nullopt;
}

}  // namespace arthro::simulation
