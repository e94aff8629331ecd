// A smooth choice of one layer per cell from the scores of all layers, by semi-global matching
// [Hirschmüller 2008, doi:10.1109/TPAMI.2007.1166] along eight directions.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace arthro::authoring {

struct LayerChoice {
  cv::Mat layer;       // CV_32FC1, with a fraction by a parabola; -1 where no layer has a score
  cv::Mat score;       // at the layer chosen
  cv::Mat margin;      // how far the best score at least three layers away lies below it
  cv::Mat steadiness;  // share of 5 x 5 cells whose own best layer is within one of the choice
};

// `scores`: one CV_32FC1 per layer, -1 to 1; at most -1 is no score.
LayerChoice ChooseLayers(const std::vector<cv::Mat>& scores);

}  // namespace arthro::authoring
