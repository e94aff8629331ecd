#include "authoring/phantom/clip/clip_options.h"

namespace arthro::authoring {

ClipOptions ClipOptionsOf(ClipPreset preset, int width, int height) {
  ClipOptions o;
  o.width = width;
  o.height = height;
  const auto texture = [&](double contrast, double step) {
    o.contrast = contrast;
    o.step = step;
    o.bumps = 0.2;
    o.highlights = 0.5;
    o.noise = 0.006;
    o.blur = 0.06;
  };
  switch (preset) {
    case ClipPreset::kEasy:
      o.field_of_view = RadiansFromDegrees(75);
      break;
    case ClipPreset::kMedium:
    case ClipPreset::kLong:
      texture(0.6, 0.367);
      o.frames = 40;
      o.path = ClipPath::kRaster;
      o.highlights = 0.6;
      o.noise = 0.010;
      o.shot_noise = 0.014;
      o.blur = 0.08;
      o.debris = 6;
      o.flicker = 0.05;
      o.tilt = RadiansFromDegrees(6);
      o.roll = RadiansFromDegrees(18);
      o.zoom = 0.12;
      o.bumps = 0.25;
      if (preset == ClipPreset::kLong) o.frames = 300, o.step = 0.15, o.debris = 0;
      break;
    case ClipPreset::kHard:
      texture(0.32, 0.4);
      o.frames = 48;
      o.path = ClipPath::kWander;
      o.vessels = 0.5;
      o.highlights = 0.9;
      o.noise = 0.016;
      o.shot_noise = 0.020;
      o.field_of_view = RadiansFromDegrees(105);
      o.blur = 0.16;
      o.debris = 18;
      o.flicker = 0.10;
      o.tilt = RadiansFromDegrees(9);
      o.roll = RadiansFromDegrees(35);
      o.zoom = 0.2;
      o.haze = 0.25;
      o.bumps = 0.4;
      break;
    case ClipPreset::kFaint:
      texture(0.08, 0.333);
      o.vessels = 0.1;
      o.noise = 0.012;
      o.shot_noise = 0.015;
      o.bumps = 0.1;
      break;
    case ClipPreset::kStill:
      texture(1.0, 0.35);
      o.frames = 10;
      o.path = ClipPath::kStill;
      break;
    case ClipPreset::kStrip:
      texture(0.6, 0.333);
      o.frames = 30;
      o.path = ClipPath::kStrip;
      break;
    case ClipPreset::kJump:
      texture(0.7, 0.333);
      o.jump = 1.054;
      break;
    case ClipPreset::kBlank:
      texture(0.7, 0.333);
      o.blank = 4;
      break;
    case ClipPreset::kTool:
      texture(0.6, 0.333);
      o.tool = true;
      break;
    case ClipPreset::kBumpy:
      texture(0.6, 0.333);
      o.bumps = 1.0;
      o.highlights = 0.9;
      break;
    case ClipPreset::kRelief:
      texture(0.8, 0.367);
      o.path = ClipPath::kRaster;
      o.relief = 0.1;
      break;
  }
  return o;
}

}  // namespace arthro::authoring
