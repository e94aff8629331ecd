#include "authoring/panorama/compose/cell_blend.h"

#include <opencv2/imgproc.hpp>

namespace arthro::authoring {
namespace {

constexpr int kBands = 5;  // the widest reaches 2^5 cells

struct Band {
  cv::Mat sum, weight;  // CV_32FC3, CV_32FC1
};

void Add(std::vector<Band>& bands, cv::Mat colour, cv::Mat weight, cv::Point at) {
  for (int band = 0; band <= kBands; ++band) {
    cv::Mat detail, coarse, coarse_weight;
    if (band < kBands) {
      cv::Mat wide;
      cv::pyrDown(colour, coarse);
      cv::pyrDown(weight, coarse_weight);
      cv::pyrUp(coarse, wide, colour.size());
      cv::subtract(colour, wide, detail);
    } else {
      detail = colour;
    }
    const cv::Rect place(at, colour.size());
    cv::Mat sum = bands[band].sum(place), all = bands[band].weight(place);
    for (int y = 0; y < place.height; ++y) {
      const auto* d = detail.ptr<cv::Vec3f>(y);
      const auto* w = weight.ptr<float>(y);
      auto* s = sum.ptr<cv::Vec3f>(y);
      auto* a = all.ptr<float>(y);
      for (int x = 0; x < place.width; ++x) {
        s[x] += w[x] * d[x];
        a[x] += w[x];
      }
    }
    colour = coarse;
    weight = coarse_weight;
    at.x /= 2;
    at.y /= 2;
  }
}

int RoundUp(int value) { return (value + (1 << kBands) - 1) >> kBands << kBands; }

}  // namespace

cv::Mat FilledCells(const FrameCells& cells, const Consensus& consensus, const cv::Rect& box) {
  cv::Mat colour = consensus.colour(box).clone(), own;
  cells.colour.convertTo(own, CV_32F, 1.0 / kGreySteps);
  own.copyTo(colour, cells.blend_weight);
  return colour;
}

cv::Mat BlendCells(const std::vector<FrameCells>& cells, const std::vector<cv::Mat>& shares,
                   const Consensus& consensus, const Layout& layout, const Progress& progress) {
  const cv::Size padded(RoundUp(layout.cells.width), RoundUp(layout.cells.height));
  std::vector<Band> bands(kBands + 1);
  for (int band = 0; band <= kBands; ++band) {
    const cv::Size size(padded.width >> band, padded.height >> band);
    bands[band] = {cv::Mat(size, CV_32FC3, cv::Scalar::all(0)),
                   cv::Mat(size, CV_32F, cv::Scalar(0))};
  }
  cv::Mat ground;
  cv::copyMakeBorder(consensus.colour, ground, 0, padded.height - layout.cells.height, 0,
                     padded.width - layout.cells.width, cv::BORDER_REPLICATE);

  // The consensus has a very small weight, so that every cell has a value.
  Add(bands, ground, cv::Mat(padded, CV_32F, cv::Scalar(1e-4)), {0, 0});
  for (std::size_t f = 0; f < cells.size(); ++f) {
    if (shares[f].empty()) continue;
    progress.Step("blend low frequencies",
                  static_cast<double>(f) / static_cast<double>(cells.size()));
    // The frame in a box aligned to the coarsest band, with one coarse pixel around it.
    const cv::Rect& own = layout.frames[f].cells;
    const int margin = 1 << kBands;
    const cv::Point first((own.x >> kBands << kBands) - margin,
                          (own.y >> kBands << kBands) - margin);
    const cv::Rect box =
        cv::Rect(first, cv::Point(RoundUp(own.br().x) + margin, RoundUp(own.br().y) + margin)) &
        cv::Rect({0, 0}, padded);
    const cv::Rect inside(own.tl() - box.tl(), own.size());
    cv::Mat colour = ground(box).clone(), weight(box.size(), CV_32F, cv::Scalar(0));
    FilledCells(cells[f], consensus, own).copyTo(colour(inside));
    shares[f].convertTo(weight(inside), CV_32F, 1.0 / 255);
    Add(bands, colour, weight, box.tl());
  }
  cv::Mat picture;
  for (int band = kBands; band >= 0; --band) {
    cv::Mat own = bands[band].sum.clone();
    for (int y = 0; y < own.rows; ++y)
      for (int x = 0; x < own.cols; ++x)
        own.at<cv::Vec3f>(y, x) *= 1.f / bands[band].weight.at<float>(y, x);
    if (!picture.empty()) {
      cv::Mat wide;
      cv::pyrUp(picture, wide, own.size());
      own += wide;
    }
    picture = own;
  }
  return picture(cv::Rect({0, 0}, layout.cells)).clone();
}

}  // namespace arthro::authoring
