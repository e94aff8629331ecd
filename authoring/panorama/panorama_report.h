// What became of a clip: the panorama's geometry and, for every frame of the footage, where it lies
// or why it does not. Plain types, so that a window can show it. File: report_io.h [method.md, File
// formats].
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "authoring/panorama/stage_clock.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

// A picture that pinholes take: x right, y down, origin at the centre of the top-left pixel, px.
struct PinholeView {
  int width = 0, height = 0;
  double focal_px = 0, cx = 0, cy = 0;
};

struct FrameReport {
  int index = 0;       // in the footage
  std::string source;  // the file, or the video and the frame's number
  bool is_placed = false;
  bool is_usable = false;  // it was tried: readable, of the right size, not blank, not left out
  std::string reason;      // why it is not placed; "" when it is
  int component = -1;      // 0: the panorama; 1…: a piece that does not join it; -1: none
  std::array<double, 9> panorama_from_rectified{1, 0, 0, 0, 1, 0, 0, 0, 1};  // of its component
  int inliers = 0;
  double rms_px = 0, expected_error_px = 0;
};

// Frames that hold together but do not join the panorama.
struct PieceReport {
  int component = 0;
  int frames = 0;
  std::string file;  // "" when it was not written
  PinholeView panorama;
};

struct PanoramaReport {
  std::string footage;
  bool is_partial = false;
  std::string summary;  // one sentence; begins with "partial:" when it is
  Lens lens;
  bool is_lens_guessed = false;
  PinholeView rectified, panorama;
  std::vector<FrameReport> frames;
  double mean_error_px = 0, max_error_px = 0;  // of what is expected of the placed frames
  double drift_px = 0;
  double wanders_px = 0;  // how far the round window moved over the clip
  std::string detector;
  int seed = 0;
  std::vector<StageCost> stages;
  double peak_memory_mb = 0;
  std::vector<std::string> warnings;
  std::vector<PieceReport> pieces;
  std::string options;  // as JSON
};

struct RgbaPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  // straight alpha; row-major from the top-left pixel
  bool empty() const { return width <= 0 || height <= 0; }
};

}  // namespace arthro::authoring
