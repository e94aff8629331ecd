// Disturbances of the picture for training: bleeding, turbid fluid, air bubbles, loose fibrous
// tissue and near objects obscure the view in real procedures [Tuijthof, Sierevelt & van Dijk
// 2007]; a fogged, ill-focused or overexposed camera joins them. Strengths are 0 (none) to 1.
// Values of a session; app/view draws them. Moving parts are functions of seed and time alone: the
// same values give the same bytes.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "simulation/core/options.h"

namespace arthro::simulation {

inline constexpr std::size_t kDisturbances = 7;

struct Disturbances {
  double haze = 0;          // blood in the fluid
  double bubbles = 0;       // air
  double debris = 0;        // loose fibres and flakes
  double fog = 0;           // dew on the lens, from its rim inwards
  double near_blur = 0;     // focused on far parts: near ones are blurred
  double far_blur = 0;      // focused on near parts: far ones are blurred
  double overexposure = 0;  // too much light for the camera
  int seed = 0;
  double time = 0;  // s; villi of tissues sway by it as well

  // Visits the strengths alone, since seed and time are no choice of a person.
  template <class V>
  void Visit(V&& v) {
    constexpr Range kStrength{0.0, 1.0};
    v("haze", haze, kStrength, "", "Blood in the fluid: a red veil, thicker with distance.");
    v("bubbles", bubbles, kStrength, "", "Air bubbles that rise, and some on the lens.");
    v("debris", debris, kStrength, "", "Loose flakes and fibres that drift in the fluid.");
    v("fog", fog, kStrength, "", "A fogged lens: a milky veil from the rim inwards.");
    v("near_blur", near_blur, kStrength, "", "Out of focus: what is near is blurred.");
    v("far_blur", far_blur, kStrength, "", "Out of focus: what is far is blurred.");
    v("overexposure", overexposure, kStrength, "", "Too much light for the camera.");
  }

  bool is_any() const {
    return haze > 0 || bubbles > 0 || debris > 0 || fog > 0 || near_blur > 0 || far_blur > 0 ||
           overexposure > 0;
  }
  // True when the picture changes with time.
  bool is_moving() const { return haze > 0 || bubbles > 0 || debris > 0; }
  friend bool operator==(const Disturbances&, const Disturbances&) = default;
};

// Strengths in the order of Visit.
std::array<double, kDisturbances> StrengthsOf(Disturbances disturbances) noexcept;
Disturbances DisturbancesOf(const std::array<double, kDisturbances>& strengths, int seed) noexcept;

// Throws Error(kBadArgument) with the first strength out of range, or a time that is not finite.
void CheckDisturbances(const Disturbances& disturbances);

// Reads "haze=0.5,bubbles=0.3": strengths by name, each at most once. Throws Error(kBadArgument)
// with the names that exist, or with the strength that is wrong.
Disturbances ParseDisturbances(std::string_view list);

// Returns "haze (blood in the fluid: …); bubbles (…)" for a help text, by the one list of them.
std::string DisturbanceHelp();

// Extinction of red, green and blue light in fluid with blood, at strength 1 and mean density. A
// few per cent of oxygenated blood absorb green and blue some four times as strongly as red.
inline constexpr double kHazeExtinction[3] = {27.0, 100.0, 95.0};  // 1/m

}  // namespace arthro::simulation
