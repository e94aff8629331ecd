// Pairs of portals of the knee by the names that surgeons use, as incision spacings of a knee side.
// The knee is seen from its front, as the surgeon stands: the lateral side of a right knee is on
// the left. The anterior portals lie beside the patellar tendon, taken as 30 mm wide; the distances
// are values to start from, not measurements of a patient. m.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace arthro::simulation {

struct NamedPortals {
  const char* word;   // on the command line
  const char* title;  // "Anterolateral, anteromedial": scope, instrument
  double medially;    // m, from the scope's portal to the instrument's, positive towards medial
};
std::span<const NamedPortals> EveryNamedPortals();
const NamedPortals* FindNamedPortals(std::string_view word);  // null: there is none

// Incision spacing: positive to the viewer's right.
double SpacingOf(const NamedPortals& portals, bool is_left_knee);
// Index of the pair with this spacing to 0.1 mm; nothing for one without a name.
std::optional<int> NamedPortalsAt(double spacing, bool is_left_knee);

}  // namespace arthro::simulation
