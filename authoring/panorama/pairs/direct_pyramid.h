// Data of a frame for direct alignment: its fine texture alone, at a half, a quarter and an eighth
// of the rectified scale (for working frames at scale 0.5). Each level keeps wavelengths of about 4
// to 16 of its own pixels, which removes haze, light and pixel noise. Values are in units of the
// level's robust deviation and clipped at three of them, so that debris and highlights weigh no
// more than strong texture. A pixel takes one byte.
//
// Two bands per level, for the two kinds of tissue texture:
//   colour  the grey itself. Painted texture looks the same from every position of the scope.
//   relief  its difference along the radius from the picture's middle. The light sits at the scope,
//           so a bump h shades as r·∇h, r from the middle: the sign depends on the side of the
//           view, and frames from opposite sides are each other's negative. The radial derivative
//           of that, about r (k·r̂)² h for each wave k, keeps its sign.
//
// Pixel of a level after k halvings: x_level = x_work / 2^k, with x_work = (x + 0.5) scale - 0.5.
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/frames/working_frame.h"
#include "authoring/panorama/pairs/direct_options.h"

namespace arthro::authoring {

inline constexpr int kDirectLevels = 3;
inline constexpr float kBandUnit = 32.0f;  // stored value of one deviation
inline constexpr int kNoBand = -128;       // stored value of an invalid pixel

struct DirectBand {
  cv::Mat values;                    // CV_8SC1
  std::vector<std::int32_t> points;  // indices of the pixels that are aligned, ascending
};

enum Texture { kColour, kRelief, kTextures };

struct DirectLevel {
  cv::Matx33d level_from_rectified;
  DirectBand bands[kTextures];
  cv::Size size() const { return bands[kColour].values.size(); }
};

class DirectPyramid {
 public:
  explicit DirectPyramid(const WorkingFrame& frame, const DirectOptions& options = {});

  int index() const { return index_; }
  // Level 0 is the finest. Every level exists; a frame without texture or mask has levels without
  // points.
  const DirectLevel& level(int k) const { return levels_[k]; }
  // Fourier transform of a band of the coarsest level, packed as by cv::dft; empty for a frame
  // without texture.
  const cv::Mat& spectrum(Texture texture) const { return spectra_[texture]; }
  bool HasTexture() const { return !spectra_[kColour].empty(); }

 private:
  int index_ = 0;
  DirectLevel levels_[kDirectLevels];
  cv::Mat spectra_[kTextures];
};

// Band as float, multiplied by a soft mask that is 0 at the border of the valid area, on a canvas
// for cv::dft.
cv::Mat ApodisedBand(const DirectBand& band, cv::Size canvas);
cv::Size SpectrumSize(cv::Size level);

}  // namespace arthro::authoring
