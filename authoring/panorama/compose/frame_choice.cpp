#include "authoring/panorama/compose/frame_choice.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace arthro::authoring {
namespace {

constexpr double kDoubt = 8;          // px: with this expected error half is taken from the mean
constexpr int kDetailReach = 7;       // cells; coarser structure is no detail
constexpr int kSweeps = 12;           // borders move by a cell per sweep
constexpr double kSeamCost = 0.02;    // loss of log score per grey level and pair of cells
constexpr double kSeamLength = 0.15;  // loss of log score per pair of cells

// Luma of a frame's cells without the structure that is wider than kDetailReach.
cv::Mat DetailOf(const FrameCells& cells) {
  cv::Mat colour, grey, seen, mean, share;
  cells.colour.convertTo(colour, CV_32F, 1.0 / kGreySteps);
  cv::cvtColor(colour, grey, cv::COLOR_RGB2GRAY);
  cv::Mat(cells.blend_weight >= 64).convertTo(seen, CV_32F, 1.0 / 255);
  const cv::Size window(kDetailReach, kDetailReach);
  cv::boxFilter(grey.mul(seen), mean, CV_32F, window, {-1, -1}, true, cv::BORDER_CONSTANT);
  cv::boxFilter(seen, share, CV_32F, window, {-1, -1}, true, cv::BORDER_CONSTANT);
  cv::Mat detail = grey - mean / cv::max(share, 1e-3f);
  detail.setTo(0, share < 0.99f);  // beside the border and glare
  return detail;
}

}  // namespace

double ShareOfMean(const LaidFrame& frame) {
  return 1 / (1 + std::pow(frame.expected_error_px / kDoubt, 4));
}

std::vector<double> SharpnessOf(const std::vector<FrameCells>& cells, const Layout& layout,
                                const Progress& progress) {
  // Energy of the detail of all frames, and the number of frames that it belongs to.
  cv::Mat count(layout.cells, CV_32F, cv::Scalar(0)), energy = count.clone();
  const auto for_each = [&](double done, const auto& take) {
    for (std::size_t f = 0; f < cells.size(); ++f) {
      if (!cells[f].is_seen()) continue;
      progress.Step("compare frames", done + 0.5 * double(f) / double(cells.size()));
      const cv::Mat detail = DetailOf(cells[f]);
      take(f, layout.frames[f].cells, cv::Mat(detail.mul(detail)));
    }
  };
  for_each(0.0, [&](std::size_t, const cv::Rect& box, const cv::Mat& own) {
    cv::Mat is_compared;
    cv::Mat(own > 0).convertTo(is_compared, CV_32F, 1.0 / 255);
    count(box) += is_compared;
    energy(box) += own;
  });
  energy /= cv::max(count, 1.0f);
  std::vector<double> sharpness(cells.size(), 1);
  for_each(0.5, [&](std::size_t f, const cv::Rect& box, const cv::Mat& own) {
    const cv::Mat is_compared = (own > 0) & (count(box) >= 2);
    const double one = cv::mean(own, is_compared)[0], all = cv::mean(energy(box), is_compared)[0];
    if (one > 0 && all > 0) sharpness[f] = std::sqrt(one / all);
  });
  return sharpness;
}

cv::Mat ChooseFrames(const std::vector<FrameCells>& cells, const std::vector<cv::Mat>& score,
                     const Layout& layout, const Progress& progress) {
  const auto shows = [&](int f, int x, int y) {
    const cv::Rect& box = layout.frames[f].cells;
    return box.contains({x, y}) && cells[f].blend_weight.at<uchar>(y - box.y, x - box.x) > 0;
  };
  const auto colour = [&](int f, int x, int y) -> const cv::Vec3w& {
    const cv::Rect& box = layout.frames[f].cells;
    return cells[f].colour.at<cv::Vec3w>(y - box.y, x - box.x);
  };
  const auto off = [&](int f, int g, int x, int y) {
    if (!shows(f, x, y) || !shows(g, x, y)) return 0.0;
    const cv::Vec3w &a = colour(f, x, y), &b = colour(g, x, y);
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += std::abs(a[c] - b[c]) / kGreySteps;
    return sum / 3;
  };
  const auto worth = [&](int f, int x, int y) {
    const cv::Rect& box = layout.frames[f].cells;
    return std::log(std::max(1e-6f, score[f].at<float>(y - box.y, x - box.x)));
  };
  cv::Mat chosen(layout.cells, CV_16S, cv::Scalar(-1));
  for (int y = 0; y < layout.cells.height; ++y)
    ForEachCell(cells, layout, y, [&](int x, const std::vector<int>& views) {
      chosen.at<short>(y, x) =
          static_cast<short>(*std::max_element(views.begin(), views.end(), [&](int f, int g) {
            return worth(f, x, y) < worth(g, x, y);
          }));
    });
  // Each sweep lets a cell take the frame of a neighbour, where score and borders gain by it
  // [Besag 1986, iterated conditional modes].
  const std::array<cv::Point, 4> sides = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  const cv::Rect whole({0, 0}, layout.cells);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    progress.Step("choose frames", 0.5 + 0.4 * sweep / kSweeps);
    int changed = 0;
    for (int y = 0; y < chosen.rows; ++y)
      for (int x = 0; x < chosen.cols; ++x) {
        const int own = chosen.at<short>(y, x);
        if (own < 0) continue;
        std::array<int, 4> around{};
        int count = 0, others = 0;
        for (const cv::Point& side : sides) {
          const cv::Point at = cv::Point(x, y) + side;
          const int g = whole.contains(at) ? chosen.at<short>(at) : -1;
          around[count++] = g;
          others += g >= 0 && g != own;
        }
        if (others == 0) continue;
        const auto gain = [&](int f) {
          double value = worth(f, x, y);
          for (int i = 0; i < count; ++i) {
            const int g = around[i];
            if (g < 0 || g == f) continue;
            const cv::Point at = cv::Point(x, y) + sides[i];
            value -= kSeamLength + kSeamCost * (off(f, g, x, y) + off(f, g, at.x, at.y));
          }
          return value;
        };
        int best = own;
        double most = gain(own);
        for (int i = 0; i < count; ++i) {
          const int g = around[i];
          if (g < 0 || g == best || !shows(g, x, y)) continue;
          const double value = gain(g);
          if (value > most + 1e-9) {
            most = value;
            best = g;
          }
        }
        if (best != own) {
          chosen.at<short>(y, x) = static_cast<short>(best);
          ++changed;
        }
      }
    if (changed == 0) break;
  }
  return chosen;
}

}  // namespace arthro::authoring
