// What direct alignment looks at in a frame: its fine texture alone, at a half, a quarter and an
// eighth of the rectified scale (for working frames at scale 0.5). Each level keeps the wavelengths
// of about 4 to 16 of its own pixels, so that neither slow haze and light nor pixel noise counts,
// in units of its own robust deviation and cut off at three of them, so that debris and glints
// weigh no more than strong texture. Compact: a byte a pixel.
//
// Two bands a level, as tissue has two kinds of texture:
//   colour  the grey itself. Painted texture looks the same wherever the scope stands.
//   relief  its difference along the radius from the picture's middle. The light sits at the scope,
//           so a bump h shades as r·∇h, r from the middle: the sign turns with the side from which
//           it is seen, and frames that see it from opposite sides are each other's negative. The
//           radial derivative of that, about r (k·r̂)² h for each wave k, keeps its sign.
//
// A level's pixel, k times halved: x_level = x_work / 2^k, with x_work = (x + 0.5) scale - 0.5.
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/frames/working_frame.h"
#include "authoring/panorama/pairs/direct_options.h"

namespace arthro::authoring {

inline constexpr int kDirectLevels = 3;
inline constexpr float kBandUnit = 32.0f;  // stored value of one deviation
inline constexpr int kNoBand = -128;       // stored value where there is nothing to compare

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
  // 0 is the finest. Every level exists; a frame without texture or mask has levels without points.
  const DirectLevel& level(int k) const { return levels_[k]; }
  // Fourier transform of a band of the coarsest level, as cv::dft packs it; empty for a frame
  // without texture.
  const cv::Mat& spectrum(Texture texture) const { return spectra_[texture]; }
  bool HasTexture() const { return !spectra_[kColour].empty(); }

 private:
  int index_ = 0;
  DirectLevel levels_[kDirectLevels];
  cv::Mat spectra_[kTextures];
};

// The band as float, times a soft mask that is 0 at the border of what is valid, on a canvas for
// cv::dft.
cv::Mat ApodisedBand(const DirectBand& band, cv::Size canvas);
cv::Size SpectrumSize(cv::Size level);

}  // namespace arthro::authoring
