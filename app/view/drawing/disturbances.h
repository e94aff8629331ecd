// What comes between an arthroscope and a clear picture, for training: bleeding, turbid fluid, air
// bubbles, loose fibrous tissue and what is too close are what obscures the view in real
// procedures [Tuijthof, Sierevelt & van Dijk 2007]; a fogged, ill-focused or overexposed camera
// joins them. Strengths 0 (none) to 1. All that moves is a function of seed and time alone: same
// values, same bytes.
#pragma once

#include <string>
#include <string_view>

#include "simulation/core/options.h"

namespace arthro::app {

struct Disturbances {
  double haze = 0;          // of blood in the fluid
  double bubbles = 0;       // of air
  double debris = 0;        // loose fibres and flakes
  double fog = 0;           // on the lens, from its rim inwards
  double near_blur = 0;     // focused on the far: what is near is blurred
  double far_blur = 0;      // focused on the near
  double overexposure = 0;  // of the camera
  int seed = 0;
  double time = 0;  // s

  // The strengths alone: seed and time are not a person's choice of what disturbs.
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
  // Its picture changes with time.
  bool is_moving() const { return haze > 0 || bubbles > 0 || debris > 0; }
  friend bool operator==(const Disturbances&, const Disturbances&) = default;
};

// Throws Error(kBadArgument) that names the first strength that is none, or a time that is none.
void CheckDisturbances(const Disturbances& disturbances);

// "haze=0.5,bubbles=0.3": strengths by name, each at most once. Throws Error(kBadArgument) with the
// names that there are, or the strength that is none.
Disturbances ParseDisturbances(std::string_view list);

// The optics of a blurred picture. An aperture, opened by the strength, sees a point as a disc of
// aperture · |1/distance − 1/focus| rad.
inline constexpr double kBlurAperture = 0.6e-3;  // m, at strength 1
inline constexpr double kNearBlurFocus = 30e-3;  // m; what is nearer is blurred
inline constexpr double kFarBlurFocus = 7e-3;    // m; what is further is blurred

// Diameter of that disc in the middle of the window, px.
double BlurDiameter(const Disturbances& disturbances, double distance, double field_of_view,
                    double window_radius_px);

// Stops of light too much at strength 1.
inline constexpr double kOverexposureStops = 2.0;
// The factor on linear light.
double ExposureGain(double overexposure);

// What a fluid with blood lets pass of red, green and blue over 1 m, as an exponent at strength 1
// and mean density: oxygenated blood of a few per cent takes green and blue some four times as
// strongly as red.
inline constexpr double kHazeExtinction[3] = {27.0, 100.0, 95.0};  // 1/m

}  // namespace arthro::app
