// Content and disturbances of a rendered clip. Lengths on the plane and in the picture are shares
// of the round window's radius, so that a small picture shows the same scene as a large one.
#pragma once

#include "simulation/core/options.h"

namespace arthro::authoring {

enum class ClipPath { kLoop, kRaster, kStrip, kWander, kStill };

// easy … hard: measured sequences of rising difficulty. The others are easy or medium sequences
// with one disturbance.
enum class ClipPreset {
  kEasy,
  kMedium,
  kHard,
  kFaint,
  kStill,
  kStrip,
  kJump,
  kBlank,
  kTool,
  kBumpy,
  kRelief,
  kLong
};

struct ClipOptions {
  int seed = 1;
  int frames = 32;
  int width = 800, height = 640;
  double field_of_view = RadiansFromDegrees(90);
  double window = 0.9375;
  ClipPath path = ClipPath::kLoop;
  double step = 0.35;
  double tilt = RadiansFromDegrees(4);
  double roll = RadiansFromDegrees(12);
  double zoom = 0.08;
  double roll_sweep = 0;
  double zoom_sweep = 1;
  double jump = 0;
  double contrast = 1;
  double vessels = 1;
  bool repeated = false;
  double relief = 0;
  double falloff = 1;
  double vignette = 0.35;
  double highlights = 0.35;
  double bumps = 0.15;
  double flicker = 0.02;
  double exposure_step = 1;
  double gamma = 1.6;
  double noise = 0.004;
  double shot_noise = 0.010;
  double blur = 0.04;
  double haze = 0;
  int debris = 0;
  int blank = 0;
  bool tool = false;
  bool marks = false;

  template <class V>
  void Visit(V&& v) {
    v("seed", seed, Range{0, 2147483647}, "", "Preset of plane, path and noise.");
    v("frames", frames, Range{1, 100000}, "", "Length of the clip.");
    v("width", width, Range{32, 8192}, "px", "Width of a frame.");
    v("height", height, Range{32, 8192}, "px", "Height of a frame.");
    v("field_of_view", field_of_view, Range{RadiansFromDegrees(20), RadiansFromDegrees(140)}, "rad",
      "Full angle across the round window.");
    v("window", window, Range{0.2, 1.5}, "",
      "Radius of the round window as a share of half the frame's shorter side; above 1 the frame "
      "cuts it off.");
    v("path", path,
      Choices<ClipPath>{{{ClipPath::kLoop, "loop"},
                         {ClipPath::kRaster, "raster"},
                         {ClipPath::kStrip, "strip"},
                         {ClipPath::kWander, "wander"},
                         {ClipPath::kStill, "still"}}},
      "",
      "Path over the plane: a closed loop, three rows, a line, a figure that returns, or none.");
    v("step", step, Range{0, 2}, "", "Movement per frame, as a share of the window's radius.");
    v("tilt", tilt, Range{0, 0.5}, "rad", "Angle of the view to the plane's normal.");
    v("roll", roll, Range{0, 3.2}, "rad", "Amplitude of the picture's rotation.");
    v("zoom", zoom, Range{0, 0.6}, "", "Share by which the distance rises and falls.");
    v("roll_sweep", roll_sweep, Range{-7, 7}, "rad",
      "Rotation added uniformly over the whole clip.");
    v("zoom_sweep", zoom_sweep, Range{0.25, 4}, "",
      "Factor by which the distance changes uniformly over the whole clip.");
    v("jump", jump, Range{0, 10}, "",
      "Sudden move in the middle of the clip, as a share of the window's radius, with a rotation "
      "of 20 degrees; 0 is none.");
    v("contrast", contrast, Range{0, 2}, "", "Strength of the tissue's texture.");
    v("vessels", vessels, Range{0, 2}, "", "Strength of the blood vessels.");
    v("repeated", repeated, Any{}, "", "Repeat one patch of texture.");
    v("relief", relief, Range{0, 0.5}, "",
      "Height of the ground, shares of the window's radius; above 0 no homography is exact.");
    v("falloff", falloff, Range{0, 2}, "",
      "Exponent on the light's inverse-square falloff and cosine.");
    v("vignette", vignette, Range{0, 0.95}, "", "Share of light lost at the window's rim.");
    v("highlights", highlights, Range{0, 5}, "", "Strength of the highlights.");
    v("bumps", bumps, Range{0, 3}, "", "Strength of the shading by small bumps.");
    v("flicker", flicker, Range{0, 0.5}, "", "Spread of the exposure from frame to frame.");
    v("exposure_step", exposure_step, Range{0.1, 10}, "",
      "Factor on the exposure from the middle of the clip on.");
    v("gamma", gamma, Range{1, 3}, "", "The camera's encoding.");
    v("noise", noise, Range{0, 0.3}, "", "Sensor noise, share of white before the encoding.");
    v("shot_noise", shot_noise, Range{0, 0.3}, "", "Noise of the light, at white.");
    v("blur", blur, Range{0, 1}, "",
      "Share of the time between frames in which the shutter is open.");
    v("haze", haze, Range{0, 1}, "", "Clouds in the water.");
    v("debris", debris, Range{0, 200}, "", "Floating bits.");
    v("blank", blank, Range{0, 1000}, "", "Number of frames that are red throughout.");
    v("tool", tool, Any{}, "", "A shaft moves through a quarter of the view.");
    v("marks", marks, Any{}, "",
      "Dirt on the lens and text inside the window, fixed in the frame.");
  }
};

// Options of a preset for frames of the given size; all others may be changed afterwards.
ClipOptions ClipOptionsOf(ClipPreset preset, int width = 800, int height = 640);

}  // namespace arthro::authoring
