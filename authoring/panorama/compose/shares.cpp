#include "authoring/panorama/compose/shares.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "authoring/panorama/compose/frame_choice.h"

namespace arthro::authoring {
namespace {

// Exponent of the quality; on clips with known truth 1 and 5 are up to 0.3 dB worse than 2.
constexpr double kSharing = 2;
constexpr double kSoftEdge = 48;  // px over which a frame fades in from its rim

// Ramp from 0 at the rim of the frame's visible area to 1 at `reach` cells inside.
cv::Mat EdgeOf(const cv::Mat& blend_weight, double reach) {
  cv::Mat padded, distance;
  cv::copyMakeBorder(blend_weight > 0, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::distanceTransform(padded, distance, cv::DIST_L2, 3, CV_32F);
  cv::Mat edge = distance(cv::Rect(1, 1, blend_weight.cols, blend_weight.rows)) / reach;
  return cv::min(edge, 1.0f);
}

}  // namespace

std::vector<cv::Mat> ShareCells(const std::vector<FrameCells>& cells,
                                const std::vector<CellRays>& rays, const Layout& layout,
                                const ComposeOptions& options, const Progress& progress) {
  const std::vector<double> sharpness = SharpnessOf(cells, layout, progress);
  std::vector<cv::Mat> score(cells.size()), choice(cells.size());
  for (std::size_t f = 0; f < cells.size(); ++f) {
    if (!cells[f].is_seen()) continue;
    progress.Step("choose frames",
                  0.5 * static_cast<double>(f) / static_cast<double>(cells.size()));
    const cv::Rect& box = layout.frames[f].cells;
    cv::Mat s = EdgeOf(cells[f].blend_weight, kSoftEdge / layout.cell);
    cv::Mat one(box.size(), CV_32F, cv::Scalar(0));
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x) {
        const int blend_weight = cells[f].blend_weight.at<uchar>(y, x);
        float& v = s.at<float>(y, x);
        if (blend_weight == 0) continue;
        const double q = std::min(2.0, rays[f].At(box.x + x, box.y + y).sharpness);
        const double worth = (v + 1e-4) * blend_weight / 255.0 * q;
        v = static_cast<float>(layout.frames[f].trust * worth);
        one.at<float>(y, x) = static_cast<float>(worth * q * sharpness[f]);
      }
    score[f] = s;
    choice[f] = one;
  }
  // The frame that a cell takes where a mean would lose detail.
  const cv::Mat chosen = ChooseFrames(cells, choice, layout, progress);
  std::vector<cv::Mat> shares(cells.size());
  for (std::size_t f = 0; f < cells.size(); ++f)
    if (cells[f].is_seen()) shares[f] = cv::Mat::zeros(cells[f].blend_weight.size(), CV_8U);
  for (int y = 0; y < layout.cells.height; ++y) {
    if (y % 16 == 0) progress.Step("choose frames", 0.9 + 0.1 * y / layout.cells.height);
    ForEachCell(cells, layout, y, [&](int x, const std::vector<int>& views) {
      double sum = 0, most = 0;
      const auto at = [&](int f) {
        const cv::Rect& box = layout.frames[f].cells;
        return static_cast<double>(score[f].at<float>(y - box.y, x - box.x));
      };
      for (const int f : views) most = std::max(most, at(f));
      for (const int f : views) sum += std::pow(at(f) / most, kSharing);
      // Frames whose places are in doubt by many pixels have no common detail.
      double together = 0;
      for (const int f : views) together += ShareOfMean(layout.frames[f]);
      const double averaged = options.averaging * together / static_cast<double>(views.size());
      const int one = chosen.at<short>(y, x);
      for (const int f : views) {
        const cv::Rect& box = layout.frames[f].cells;
        const double share = averaged * std::pow(at(f) / most, kSharing) / sum;
        shares[f].at<uchar>(y - box.y, x - box.x) =
            cv::saturate_cast<uchar>(255 * (f == one ? share + 1 - averaged : share));
      }
    });
  }
  return shares;
}

}  // namespace arthro::authoring
