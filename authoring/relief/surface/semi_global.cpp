#include "authoring/relief/surface/semi_global.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

namespace arthro::authoring {
namespace {

constexpr float kStepCost = 0.06f;  // cost of one layer between neighbours
constexpr float kJumpCost = 0.35f;  // cost of more than one layer
constexpr float kNoScore = 0.9f;    // cost of a layer that too few frames see
constexpr int kApart = 3;           // layers, to count as another peak

// Costs of one cell lie side by side.
struct Volume {
  int width, height, layers;
  std::vector<float> cost;
  float* At(int x, int y) {
    return &cost[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)) *
                 static_cast<std::size_t>(layers)];
  }
  const float* At(int x, int y) const { return const_cast<Volume*>(this)->At(x, y); }
};

// Adds the path costs of one direction to the sum.
void AddPaths(const Volume& costs, int dx, int dy, Volume& sum) {
  const int layers = costs.layers;
  Volume path{costs.width, costs.height, layers, std::vector<float>(costs.cost.size())};
  const auto range = [](int count, int step) {
    return step < 0 ? std::pair(count - 1, -1) : std::pair(0, 1);
  };
  const auto [x0, sx] = range(costs.width, dx);
  const auto [y0, sy] = range(costs.height, dy);
  for (int j = 0, y = y0; j < costs.height; ++j, y += sy)
    for (int i = 0, x = x0; i < costs.width; ++i, x += sx) {
      const float* own = costs.At(x, y);
      float *out = path.At(x, y), *total = sum.At(x, y);
      const int px = x - dx, py = y - dy;
      if (px < 0 || py < 0 || px >= costs.width || py >= costs.height) {
        for (int k = 0; k < layers; ++k) total[k] += out[k] = own[k];
        continue;
      }
      const float* before = path.At(px, py);
      const float least = *std::min_element(before, before + layers);
      for (int k = 0; k < layers; ++k) {
        float way = std::min(before[k], least + kJumpCost);
        if (k > 0) way = std::min(way, before[k - 1] + kStepCost);
        if (k + 1 < layers) way = std::min(way, before[k + 1] + kStepCost);
        total[k] += out[k] = own[k] + way - least;
      }
    }
}

}  // namespace

LayerChoice ChooseLayers(const std::vector<cv::Mat>& scores) {
  const cv::Size size = scores.front().size();
  const int layers = static_cast<int>(scores.size());
  Volume costs{size.width, size.height, layers, {}};
  costs.cost.resize(static_cast<std::size_t>(size.area()) * scores.size());
  for (int k = 0; k < layers; ++k)
    for (int y = 0; y < size.height; ++y) {
      const float* score = scores[static_cast<std::size_t>(k)].ptr<float>(y);
      for (int x = 0; x < size.width; ++x)
        costs.At(x, y)[k] = score[x] > -1 ? 1 - std::max(0.0f, score[x]) : kNoScore;
    }
  Volume sum{size.width, size.height, layers, std::vector<float>(costs.cost.size(), 0)};
  for (const auto& [dx, dy] :
       {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1), std::pair(1, 1),
        std::pair(-1, 1), std::pair(1, -1), std::pair(-1, -1)})
    AddPaths(costs, dx, dy, sum);

  LayerChoice choice;
  choice.layer = cv::Mat(size, CV_32F, cv::Scalar(-1));
  choice.score = cv::Mat(size, CV_32F, cv::Scalar(-1));
  choice.margin = cv::Mat::zeros(size, CV_32F);
  cv::Mat steady = cv::Mat::zeros(size, CV_32F);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const float *own = costs.At(x, y), *all = sum.At(x, y);
      int best = -1, single = 0;
      for (int k = 0; k < layers; ++k) {
        if (scores[static_cast<std::size_t>(k)].at<float>(y, x) <= -1) continue;
        if (best < 0 || all[k] < all[best]) best = k;
        if (own[k] < own[single]) single = k;
      }
      if (best < 0) continue;
      float layer = static_cast<float>(best);
      if (best > 0 && best + 1 < layers) {
        const float bend = all[best - 1] - 2 * all[best] + all[best + 1];
        if (bend > 1e-6f)
          layer += std::clamp(0.5f * (all[best - 1] - all[best + 1]) / bend, -0.5f, 0.5f);
      }
      float second = 1;
      for (int k = 0; k < layers; ++k)
        if (std::abs(k - best) >= kApart) second = std::min(second, own[k]);
      choice.layer.at<float>(y, x) = layer;
      choice.score.at<float>(y, x) = 1 - own[best];
      choice.margin.at<float>(y, x) = second - own[best];
      steady.at<float>(y, x) = std::abs(single - best) <= 1 ? 1.0f : 0.0f;
    }
  cv::boxFilter(steady, choice.steadiness, CV_32F, {5, 5});
  return choice;
}

}  // namespace arthro::authoring
