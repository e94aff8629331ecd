// High frequencies of the panorama: the frames minus their cells' colours, accumulated frame by
// frame in three bands. Only the sums are kept.
#pragma once

#include <opencv2/core.hpp>

#include "authoring/panorama/compose/layout.h"
#include "authoring/panorama/compose/light_model.h"
#include "simulation/core/progress.h"

namespace arthro::authoring {

// A frame with everything that drawing it needs.
struct DetailSource {
  cv::Mat rectified_rgb;  // CV_8UC3
  cv::Mat tissue;         // CV_8UC1, 255 at pixels whose detail may be used
  cv::Mat slow;   // CV_32FC3 over the frame's box of cells: its own cells with evened-out light
  cv::Mat share;  // CV_8UC1 over the box of cells
  cv::Mat gain;   // CV_32FC1 over the box: factor on its linear tone
};

class DetailBlend {
 public:
  explicit DetailBlend(const Layout& layout);

  void Add(const DetailSource& source, const LaidFrame& frame, const ToneCurve& tone,
           const Progress& progress, double done);

  // Adds the low frequencies (CV_32FC3, cells) and writes RGB into `rgba`; alpha stays unchanged.
  void Finish(const cv::Mat& slow, cv::Mat& rgba, const Progress& progress) const;

 private:
  static constexpr int kBands = 3;
  int cell_ = 0;
  cv::Size cells_, size_;
  cv::Mat bands_[kBands];  // CV_16SC3, grey levels times kDetailSteps; each half the last's size
};

}  // namespace arthro::authoring
