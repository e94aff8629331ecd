#include "authoring/depth/masked_median.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "authoring/depth/imaged_area.h"

namespace arthro::authoring {
namespace {

// Largest radius for which OpenCV sorts 16-bit windows by a network of vector instructions.
constexpr int kNetworkRadius = 2;

// Share of pixels near the surround above which moving histograms are faster than sorting.
constexpr double kSortedShare = 0.05;

std::uint16_t SortedMedian(const GreyPlane& plane, int x, int y, int radius) {
  std::array<std::uint16_t, (2 * kNetworkRadius + 1) * (2 * kNetworkRadius + 1)> values;
  std::size_t count = 0;
  for (int v = std::max(0, y - radius); v <= std::min(plane.height - 1, y + radius); ++v)
    for (int u = std::max(0, x - radius); u <= std::min(plane.width - 1, x + radius); ++u)
      if (plane.imaged[plane.Index(u, v)]) values[count++] = plane.grey[plane.Index(u, v)];
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((count - 1) / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

// Huang's moving histogram: 256 bins, each of 16 groups of 16 greys. It keeps the bin of the last
// median, so that an update and a query cost few steps.
class MovingHistogram {
 public:
  void Add(std::uint16_t value) { Change(value, 1); }
  void Remove(std::uint16_t value) { Change(value, -1); }

  std::uint16_t Median() {
    const int middle = (count_ - 1) / 2;
    while (middle < below_) below_ -= bins_[--bin_];
    while (middle >= below_ + bins_[bin_]) below_ += bins_[bin_++];
    int rank = middle - below_;
    std::size_t group = bin_ * 16;
    while (rank >= groups_[group]) rank -= groups_[group++];
    std::size_t grey = group * 16;
    while (rank >= greys_[grey]) rank -= greys_[grey++];
    return static_cast<std::uint16_t>(grey);
  }

 private:
  void Change(std::uint16_t value, int step) {
    bins_[value >> 8] += step;
    groups_[value >> 4] = static_cast<std::int16_t>(groups_[value >> 4] + step);
    greys_[value] = static_cast<std::int16_t>(greys_[value] + step);
    if ((value >> 8) < static_cast<int>(bin_)) below_ += step;
    count_ += step;
  }

  std::array<int, 256> bins_{};
  std::array<std::int16_t, 4096> groups_{};
  std::array<std::int16_t, 65536> greys_{};
  std::size_t bin_ = 0;
  int below_ = 0, count_ = 0;  // values in the bins before bin_; all values
};

void MedianByHistogram(const GreyPlane& plane, int radius, std::vector<std::uint16_t>& result) {
  ForStripsOfRows(plane.height, [&](int first, int last) {
    auto histogram = std::make_unique<MovingHistogram>();  // 130 kB: too large for the stack
    for (int y = first; y < last; ++y) {
      const int top = std::max(0, y - radius), bottom = std::min(plane.height - 1, y + radius);
      const auto column = [&](int x, auto&& change) {
        if (x < 0 || x >= plane.width) return;
        for (int v = top; v <= bottom; ++v)
          if (plane.imaged[plane.Index(x, v)]) change(plane.grey[plane.Index(x, v)]);
      };
      const auto add = [&](std::uint16_t value) { histogram->Add(value); };
      const auto remove = [&](std::uint16_t value) { histogram->Remove(value); };
      for (int x = 0; x < radius; ++x) column(x, add);
      for (int x = 0; x < plane.width; ++x) {
        column(x + radius, add);
        column(x - radius - 1, remove);
        const std::size_t i = plane.Index(x, y);
        result[i] = plane.imaged[i] ? histogram->Median() : plane.grey[i];
      }
      // Removes the remaining values, which is less work than clearing the histogram.
      for (int x = plane.width - radius - 1; x < plane.width; ++x) column(x, remove);
    }
  });
}

void MedianByNetwork(const GreyPlane& plane, int radius, std::vector<std::uint16_t>& result) {
  const cv::Mat grey(plane.height, plane.width, CV_16U,
                     const_cast<std::uint16_t*>(plane.grey.data()));
  ForStripsOfRows(plane.height, [&](int first, int last) {
    const int top = std::max(0, first - radius), bottom = std::min(plane.height, last + radius);
    cv::Mat filtered;
    cv::medianBlur(grey.rowRange(top, bottom), filtered, 2 * radius + 1);
    for (int y = first; y < last; ++y)
      std::copy_n(filtered.ptr<std::uint16_t>(y - top), plane.width, &result[plane.Index(0, y)]);
  });
}

// Returns 1 where the window holds a pixel that does not count.
std::vector<std::uint8_t> NearSurround(const GreyPlane& plane, int radius) {
  std::vector<std::uint8_t> outside(plane.imaged.size());
  std::transform(plane.imaged.begin(), plane.imaged.end(), outside.begin(),
                 [](std::uint8_t imaged) { return std::uint8_t(imaged ? 0 : kDark); });
  auto near =
      Grow(RunsOf(outside, plane.width, plane.height, kDark), plane.width, plane.height, radius);
  for (int y = 0; y < plane.height; ++y) {
    const bool is_edge_row = y < radius || y >= plane.height - radius;
    const int edge = is_edge_row ? plane.width : std::min(radius, plane.width);
    std::fill_n(near.begin() + static_cast<std::ptrdiff_t>(plane.Index(0, y)), edge, 1);
    std::fill_n(near.begin() + static_cast<std::ptrdiff_t>(plane.Index(plane.width - edge, y)),
                edge, 1);
  }
  return near;
}

}  // namespace

void MaskedMedian(GreyPlane& plane, int radius) {
  if (radius <= 0) return;
  std::vector<std::uint16_t> result(plane.grey.size());
  if (radius > kNetworkRadius) {
    MedianByHistogram(plane, radius, result);
    plane.grey.swap(result);
    return;
  }
  const std::vector<std::uint8_t> near = NearSurround(plane, radius);
  std::size_t to_sort = 0;
  for (std::size_t i = 0; i < near.size(); ++i) to_sort += near[i] & plane.imaged[i];
  if (static_cast<double>(to_sort) > kSortedShare * static_cast<double>(near.size())) {
    MedianByHistogram(plane, radius, result);
  } else {
    MedianByNetwork(plane, radius, result);
    ForStripsOfRows(plane.height, [&](int first, int last) {
      for (int y = first; y < last; ++y)
        for (int x = 0; x < plane.width; ++x) {
          const std::size_t i = plane.Index(x, y);
          if (!plane.imaged[i])
            result[i] = plane.grey[i];
          else if (near[i])
            result[i] = SortedMedian(plane, x, y, radius);
        }
    });
  }
  plane.grey.swap(result);
}

}  // namespace arthro::authoring
