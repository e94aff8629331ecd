#include "authoring/panorama/compose/detail_blend.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "authoring/panorama/compose/frame_choice.h"

namespace arthro::authoring {
namespace {

constexpr float kDetailSteps = 96;   // steps per grey level: +-341 grey levels fit into 16 bits
constexpr int kTile = 384;           // px; a multiple of every cell width
constexpr int kHalo = 16;            // px around a tile, for the bands at its border
constexpr double kTakenAlone = 0.5;  // share of the mean below which a frame is mostly drawn alone

// Part of a picture on cells that a box of panorama px covers, at 2^-band of their scale. The
// cells' picture starts at `origin`, the box at `at`; all are multiples of a cell.
cv::Mat Enlarge(const cv::Mat& cells, int cell, const cv::Point& origin, const cv::Rect& box,
                int band) {
  // One additional cell around, so that interpolation at the box's border has its neighbours.
  const cv::Rect wanted(box.x / cell - 1 - origin.x, box.y / cell - 1 - origin.y,
                        box.width / cell + 2, box.height / cell + 2);
  const cv::Rect held = wanted & cv::Rect({0, 0}, cells.size());
  cv::Mat part;
  cv::copyMakeBorder(cells(held), part, held.y - wanted.y, wanted.br().y - held.br().y,
                     held.x - wanted.x, wanted.br().x - held.br().x, cv::BORDER_REPLICATE);
  cv::Mat large;
  const int factor = cell >> band;
  if (factor == 1)
    large = part;
  else
    cv::resize(part, large, part.size() * factor, 0, 0, cv::INTER_LINEAR);
  return large(cv::Rect(factor, factor, box.width >> band, box.height >> band));
}

// Adds `detail` (CV_32FC3) times `share` (CV_32FC1) to `sum` (CV_16SC3).
void Accumulate(const cv::Mat& detail, const cv::Mat& share, cv::Mat sum) {
  for (int y = 0; y < sum.rows; ++y) {
    const auto* d = detail.ptr<float>(y);
    const auto* w = share.ptr<float>(y);
    auto* s = sum.ptr<short>(y);
    for (int x = 0; x < sum.cols; ++x) {
      const float scaled = w[x] * kDetailSteps;
      for (int c = 0; c < 3; ++c)
        s[3 * x + c] =
            cv::saturate_cast<short>(static_cast<float>(s[3 * x + c]) + scaled * d[3 * x + c]);
    }
  }
}

}  // namespace

DetailBlend::DetailBlend(const Layout& layout)
    : cell_(layout.cell), cells_(layout.cells), size_(layout.size) {
  for (int band = 0; band < kBands; ++band)
    bands_[band] =
        cv::Mat::zeros(cells_.height * cell_ >> band, cells_.width * cell_ >> band, CV_16SC3);
}

void DetailBlend::Add(const DetailSource& source, const LaidFrame& frame, const ToneCurve& tone,
                      const Progress& progress, double done) {
  const cv::Rect cells = frame.cells;
  const cv::Rect whole({0, 0}, cells_ * cell_);
  float linear[256];
  for (int grey = 0; grey < 256; ++grey) linear[grey] = tone.Linear(grey);
  const int step = kTile / cell_;
  // Linear interpolation lowers the gradient of a frame by a tenth. In a mean that lowers noise
  // too.
  const int interpolation = ShareOfMean(frame) < kTakenAlone ? cv::INTER_CUBIC : cv::INTER_LINEAR;
  for (int row = cells.y; row < cells.br().y; row += step)
    for (int column = cells.x; column < cells.br().x; column += step) {
      progress.Step("blend detail", done);
      const cv::Rect tile_cells = cv::Rect(column, row, step, step) & cells;
      if (cv::countNonZero(source.share(tile_cells - cells.tl())) == 0) continue;

      // The tile and its surroundings, drawn from the frame.
      const cv::Rect tile(tile_cells.tl() * cell_, tile_cells.size() * cell_);
      const int halo = (kHalo + cell_ - 1) / cell_ * cell_;
      const cv::Rect box =
          cv::Rect(tile.tl() - cv::Point(halo, halo), tile.size() + cv::Size(2 * halo, 2 * halo)) &
          whole;
      cv::Mat drawn, tissue;
      if (frame.surface.empty()) {
        const cv::Matx33d box_from_rectified =
            cv::Matx33d(1, 0, -box.x, 0, 1, -box.y, 0, 0, 1) * frame.composed_from_rectified;
        cv::warpPerspective(source.rectified_rgb, drawn, box_from_rectified, box.size(),
                            interpolation, cv::BORDER_REPLICATE);
        cv::warpPerspective(source.tissue, tissue, box_from_rectified, box.size());
      } else {
        const cv::Mat pixel = Enlarge(frame.surface.pixel, cell_, cells.tl(), box, 0);
        cv::remap(source.rectified_rgb, drawn, pixel, cv::noArray(), interpolation,
                  cv::BORDER_REPLICATE);
        cv::remap(source.tissue, tissue, pixel, cv::noArray(), cv::INTER_LINEAR);
      }
      const cv::Mat gain = Enlarge(source.gain, cell_, cells.tl(), box, 0);
      cv::Mat detail = Enlarge(source.slow, cell_, cells.tl(), box, 0);
      for (int y = 0; y < box.height; ++y) {
        const auto* in = drawn.ptr<uchar>(y);
        const auto* is_tissue = tissue.ptr<uchar>(y);
        const auto* g = gain.ptr<float>(y);
        auto* d = detail.ptr<float>(y);
        for (int x = 0; x < box.width; ++x) {
          const float part = static_cast<float>(is_tissue[x]) * (1.f / 255);
          for (int c = 3 * x; c < 3 * x + 3; ++c)
            d[c] = is_tissue[x] == 0 ? 0 : part * (tone.Grey(g[x] * linear[in[c]]) - d[c]);
        }
      }

      // Bands of the tile's own part, each with the share at its scale.
      cv::Mat level = detail;
      cv::Mat share_cells;
      source.share.convertTo(share_cells, CV_32F, 1.0 / 255);
      for (int band = 0; band < kBands; ++band) {
        cv::Mat coarse, own;
        if (band + 1 < kBands) {
          cv::Mat wide;
          cv::pyrDown(level, coarse);
          cv::pyrUp(coarse, wide, level.size());
          cv::subtract(level, wide, own);
        } else {
          own = level;
        }
        const cv::Rect inner((tile.x - box.x) >> band, (tile.y - box.y) >> band, tile.width >> band,
                             tile.height >> band);
        const cv::Mat share = Enlarge(share_cells, cell_, cells.tl(), tile, band);
        Accumulate(
            own(inner), share,
            bands_[band](cv::Rect(tile.x >> band, tile.y >> band, inner.width, inner.height)));
        level = coarse;
      }
    }
}

void DetailBlend::Finish(const cv::Mat& slow, cv::Mat& rgba, const Progress& progress) const {
  // Processes strips with additional rows for the bands.
  const int halo = (kHalo + cell_ - 1) / cell_ * cell_;
  const int strip = std::max(cell_, 256 / cell_ * cell_);
  const cv::Size whole = bands_[0].size();
  for (int first = 0; first < size_.height; first += strip) {
    progress.Step("finish", static_cast<double>(first) / size_.height);
    const int top = std::max(0, first - halo),
              bottom = std::min(whole.height, first + strip + halo);
    cv::Mat detail;
    for (int band = kBands - 1; band >= 0; --band) {
      cv::Mat own;
      bands_[band].rowRange(top >> band, bottom >> band).convertTo(own, CV_32F, 1 / kDetailSteps);
      if (!detail.empty()) {
        cv::Mat wide;
        cv::pyrUp(detail, wide, own.size());
        own += wide;
      }
      detail = own;
    }
    const cv::Mat ground =
        Enlarge(slow, cell_, {0, 0}, cv::Rect(0, top, whole.width, bottom - top), 0);
    for (int y = first; y < std::min(size_.height, first + strip); ++y) {
      const auto* d = detail.ptr<float>(y - top);
      const auto* g = ground.ptr<float>(y - top);
      auto* out = rgba.ptr<uchar>(y);
      for (int x = 0; x < size_.width; ++x)
        for (int c = 0; c < 3; ++c)
          out[4 * x + c] = cv::saturate_cast<uchar>(d[3 * x + c] + g[3 * x + c]);
    }
  }
  progress.Step("finish", 1.0);
}

}  // namespace arthro::authoring
