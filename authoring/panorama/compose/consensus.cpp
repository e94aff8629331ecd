#include "authoring/panorama/compose/consensus.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace arthro::authoring {
namespace {

constexpr int kResidueSteps = 10;  // steps per grey level
constexpr double kDark =
    8;  // grey levels; smaller differences are noise, whatever their relative size

struct Vote {
  float value, weight;
};

float WeightedMedian(std::vector<Vote>& votes) {
  std::sort(votes.begin(), votes.end(), [](const Vote& a, const Vote& b) {
    return a.value < b.value || (a.value == b.value && a.weight < b.weight);
  });
  float all = 0;
  for (const Vote& vote : votes) all += vote.weight;
  // Interpolates between the two samples around half of the weight, so that two frames of equal
  // weight give their mean.
  float sum = 0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    sum += votes[i].weight;
    if (sum > 0.5f * all * 1.0001f) return votes[i].value;
    if (sum >= 0.5f * all * 0.9999f && i + 1 < votes.size())
      return 0.5f * (votes[i].value + votes[i + 1].value);
  }
  return votes.back().value;
}

}  // namespace

Consensus FindConsensus(std::vector<FrameCells>& cells, const std::vector<CellRays>& rays,
                        const Layout& layout, const ComposeOptions& options,
                        const Progress& progress) {
  Consensus consensus;
  consensus.colour = cv::Mat(layout.cells, CV_32FC3, cv::Scalar::all(0));
  consensus.is_known = cv::Mat(layout.cells, CV_8U, cv::Scalar(0));
  double dropped = 0, all = 0;
  std::vector<double> residues(256 * kResidueSteps, 0);  // histogram
  std::vector<Vote> votes;
  for (int y = 0; y < layout.cells.height; ++y) {
    if (y % 16 == 0) progress.Step("consensus of the frames", double(y) / layout.cells.height);
    ForEachCell(cells, layout, y, [&](int x, const std::vector<int>& views) {
      cv::Vec3f median;
      int best = 0;
      for (int c = 0; c < 3; ++c) {
        votes.clear();
        for (const int f : views) {
          const cv::Rect& box = layout.frames[f].cells;
          const int blend_weight = cells[f].blend_weight.at<uchar>(y - box.y, x - box.x);
          const float grey = static_cast<float>(
              cells[f].colour.at<cv::Vec3w>(y - box.y, x - box.x)[c] / kGreySteps);
          const float weight = static_cast<float>(blend_weight * blend_weight *
                                                  std::min(1.0, rays[f].At(x, y).sharpness));
          votes.push_back({grey, weight});
          best = std::max(best, blend_weight);
        }
        median[c] = WeightedMedian(votes);
      }
      consensus.colour.at<cv::Vec3f>(y, x) = median;
      consensus.is_known.at<uchar>(y, x) = best >= 64 ? 255 : 128;
      for (const int f : views) {
        const cv::Rect& box = layout.frames[f].cells;
        const auto& colour = cells[f].colour.at<cv::Vec3w>(y - box.y, x - box.x);
        double off = 0;
        for (int c = 0; c < 3; ++c)
          off = std::max(
              off, std::abs(std::log((colour[c] / kGreySteps + kDark) / (median[c] + kDark))));
        const double ratio = off / options.outlier, agreement = 1 / (1 + std::pow(ratio, 4));
        uchar& blend_weight = cells[f].blend_weight.at<uchar>(y - box.y, x - box.x);
        all += 1;
        if (agreement < 0.5)
          dropped += 1;
        else
          ++residues[std::min(residues.size() - 1,
                              static_cast<std::size_t>(
                                  kResidueSteps * std::abs(colour[1] / kGreySteps - median[1])))];
        blend_weight = static_cast<uchar>(std::max(1.0, blend_weight * agreement));
      }
    });
  }
  consensus.outlier_share = all > 0 ? dropped / all : 0;
  double below = 0;
  for (std::size_t i = 0; i < residues.size() && below < (all - dropped) / 2; ++i) {
    below += residues[i];
    consensus.residue = static_cast<double>(i) / kResidueSteps;
  }

  // A cell beside an outlier often shows its soft rim.
  for (FrameCells& frame : cells) {
    if (!frame.is_seen()) continue;
    cv::Mat least;
    cv::erode(frame.blend_weight, least, cv::Mat::ones(3, 3, CV_8U));
    cv::max(least, cv::Scalar(1), least);
    least.copyTo(frame.blend_weight, frame.blend_weight);
  }
  FillSmoothly(consensus.colour, consensus.is_known);
  return consensus;
}

void FillSmoothly(cv::Mat& colour, const cv::Mat& is_known) {
  // Pull: halves until everything is known. Push: each level fills the gaps of the next finer one.
  std::vector<cv::Mat> sums, weights;
  cv::Mat weight;
  is_known.convertTo(weight, CV_32F);
  cv::threshold(weight, weight, 0, 1, cv::THRESH_BINARY);
  std::vector<cv::Mat> three(3, weight);
  cv::Mat weight3;
  cv::merge(three, weight3);
  sums.push_back(colour.mul(weight3));
  weights.push_back(weight3);
  while (std::min(sums.back().rows, sums.back().cols) > 1) {
    cv::Mat sum, wide;
    const cv::Size half((sums.back().cols + 1) / 2, (sums.back().rows + 1) / 2);
    cv::resize(sums.back(), sum, half, 0, 0, cv::INTER_AREA);
    cv::resize(weights.back(), wide, half, 0, 0, cv::INTER_AREA);
    sums.push_back(sum);
    weights.push_back(wide);
  }
  cv::Mat filled = sums.back() / cv::max(weights.back(), 1e-6f);
  for (std::size_t level = sums.size() - 1; level-- > 0;) {
    cv::Mat coarse;
    cv::resize(filled, coarse, sums[level].size(), 0, 0, cv::INTER_LINEAR);
    const cv::Mat certain = cv::min(weights[level], 1.0f);
    filled = sums[level] + coarse.mul(cv::Scalar::all(1) - certain);
  }
  filled.copyTo(colour, is_known == 0);
}

}  // namespace arthro::authoring
