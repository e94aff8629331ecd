// Report on a clip: the panorama's geometry and, for every frame of the footage, its position or
// the reason for its absence. Plain types, for use by a window. File: report_io.h [method.md, File
// formats].
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "authoring/footage/pixel_box.h"
#include "authoring/panorama/clip/stage_clock.h"
#include "simulation/scene/lens.h"
#include "simulation/scene/projection.h"

namespace arthro::authoring {

// Pinhole picture: x right, y down, origin at the centre of the top-left pixel, px.
struct PinholeView {
  int width = 0, height = 0;
  double focal_px = 0, cx = 0, cy = 0;
};

struct FrameReport {
  int index = 0;       // in the footage
  std::string source;  // name of the file, or the video and the frame's number
  int clip = 0;        // index of its clip, of several
  bool is_placed = false;
  bool is_usable = false;  // it was tried: readable, of the right size, not blank, not left out
  std::string reason;      // why it is not placed; "" for a placed frame
  int component = -1;      // 0: the panorama; 1…: a piece that is not joined to it; -1: none
  std::array<double, 9> panorama_from_rectified{1, 0, 0, 0, 1, 0, 0, 0, 1};  // in its component
  int inliers = 0;
  double rms_px = 0, expected_error_px = 0;
};

// Clip of several that are joined.
struct ClipReport {
  std::string file;
  int first_frame = 0, frames = 0, usable = 0, placed = 0;
};

// A frame that was placed by hand.
struct TiedFrame {
  int index = 0;  // in the footage
  int pairs = 0;
  double rms_px = 0;             // residual of the pairs, px of the frame they were joined to
  double expected_error_px = 0;  // worst of nine points of the frame
  bool is_refined = false;       // the frame's own pixels agree, and refined the place
};

// Frames that are connected with each other but not with the panorama.
struct PieceReport {
  int component = 0;
  int frames = 0;
  std::string file;  // "" when it was not written
  PinholeView panorama;
};

struct PanoramaReport {
  std::string footage;
  bool is_partial = false;
  std::string summary;  // one sentence; begins with "partial:" for a partial panorama
  Lens lens;
  bool is_lens_guessed = false;
  PinholeView rectified, panorama;
  // Set for a panorama over a measured relief, which has no homographies: directions of its
  // pixels from the portal. `panorama` then has a size only.
  std::optional<Projection> over_relief;
  double relief_radius = 0;  // m, of the sphere that the relief is given over
  std::vector<FrameReport> frames;
  std::vector<ClipReport> clips;     // one per clip
  std::vector<TiedFrame> tied;       // in the order of their index
  std::vector<PixelBox> text_boxes;  // areas of the raw pictures that never change; a proposal
  double mean_error_px = 0, max_error_px = 0;  // expected errors of the placed frames
  double drift_px = 0;
  double wanders_px = 0;  // range of the round window's centre over the clip
  std::string detector;
  int seed = 0;
  std::vector<StageCost> stages;
  double peak_memory_mb = 0;
  std::vector<std::string> warnings;
  std::vector<PieceReport> pieces;
  std::string options;  // JSON
};

struct RgbaPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  // straight alpha; row-major from the top-left pixel
  bool empty() const { return width <= 0 || height <= 0; }
};

}  // namespace arthro::authoring
