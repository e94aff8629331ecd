#include "authoring/depth/depth_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

#include <fmt/format.h>

#include "authoring/depth/border/border_taper.h"
#include "authoring/depth/grey_plane.h"
#include "authoring/depth/highlights.h"
#include "authoring/depth/imaged_area.h"
#include "authoring/depth/light_falloff.h"
#include "authoring/depth/masked_median.h"
#include "authoring/depth/steps/step_width.h"
#include "simulation/core/error.h"
#include "simulation/core/option_fields.h"

namespace arthro::authoring {
namespace {

using Histogram = std::vector<std::uint64_t>;  // pixels by grey, kWhite + 1 entries

// Share of the imaged pixels; a larger area is overexposed tissue, not highlights.
constexpr double kMostHighlights = 0.25;

std::size_t Count(const std::vector<std::uint8_t>& marks) {
  std::size_t count = 0;
  for (const std::uint8_t mark : marks) count += mark;
  return count;
}

void MaskSurround(GreyPlane& plane, const std::vector<std::uint8_t>& flags,
                  const DepthOptions& options) {
  const RowRuns dark = RunsOf(flags, plane.width, plane.height, kDark);
  const RowRuns surround = SurroundOf(dark, flags, plane.width, plane.height);
  const auto outside = Grow(surround, plane.width, plane.height, options.border_margin);
  for (std::size_t i = 0; i < outside.size(); ++i) plane.imaged[i] = outside[i] ? 0 : 1;
}

// Mask of the pixels to fill; empty when there are none, or too many.
std::vector<std::uint8_t> HighlightsOf(const GreyPlane& plane,
                                       const std::vector<std::uint8_t>& flags, std::size_t imaged,
                                       DepthReport& report) {
  auto highlight = FindHighlights(plane, flags);
  report.highlight_share = static_cast<double>(Count(highlight)) / static_cast<double>(imaged);
  report.is_overexposed = report.highlight_share > kMostHighlights;
  if (report.highlight_share == 0.0 || report.is_overexposed) highlight.clear();
  return highlight;
}

// Adds the masked pixels to the highlights and removes the kept ones.
void TakeMarks(std::span<const DepthMark> marks, const GreyPlane& plane,
               std::vector<std::uint8_t>& highlight) {
  if (marks.size() != plane.grey.size()) return;
  if (highlight.empty()) highlight.assign(marks.size(), 0);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] == DepthMark::kMasked && plane.imaged[i]) highlight[i] = 1;
    if (marks[i] == DepthMark::kKept) highlight[i] = 0;
  }
}

Histogram HistogramOf(const GreyPlane& plane) {
  Histogram histogram(kWhite + 1, 0);
  std::mutex mutex;  // sums are integers, so the order of strips does not matter
  ForStripsOfRows(plane.height, [&](int first, int last) {
    std::vector<std::uint32_t> own(kWhite + 1, 0);
    for (std::size_t i = plane.Index(0, first); i < plane.Index(0, last); ++i)
      if (plane.imaged[i]) ++own[plane.grey[i]];
    const std::lock_guard lock(mutex);
    for (std::size_t grey = 0; grey < own.size(); ++grey) histogram[grey] += own[grey];
  });
  return histogram;
}

DepthHistogram HistogramOfGreys(const Histogram& greys) {
  DepthHistogram coarse;
  double count = 0;
  for (std::size_t grey = 0; grey < greys.size(); ++grey) {
    const std::size_t bin =
        std::min<std::size_t>(grey * DepthHistogram::kBins / kWhite, DepthHistogram::kBins - 1);
    coarse.share[bin] += static_cast<double>(greys[grey]);
    count += static_cast<double>(greys[grey]);
  }
  if (count > 0)
    for (double& share : coarse.share) share /= count;
  return coarse;
}

// Smallest grey such that at least `percent` of the pixels do not exceed it.
int Percentile(const Histogram& histogram, std::uint64_t pixels, double percent) {
  const auto wanted = std::max<std::uint64_t>(
      1, static_cast<std::uint64_t>(std::ceil(percent / 100.0 * static_cast<double>(pixels))));
  std::uint64_t seen = 0;
  for (std::size_t grey = 0; grey < histogram.size(); ++grey)
    if ((seen += histogram[grey]) >= wanted) return static_cast<int>(grey);
  return kWhite;
}

// Distance by grey, in the law's own unit; decreases as grey grows.
double DistanceOf(int grey, const DepthOptions& options) {
  constexpr double kDarkest = 1.0 / 255.0;  // one step of the camera; darker pixels hold no light
  const double share = static_cast<double>(grey) / kWhite;
  if (options.law == DepthLaw::kLinear) return 1.0 - share;
  return 1.0 / std::sqrt(std::pow(std::max(share, kDarkest), options.gamma));
}

// Relief by grey: exactly `far_relief` up to `low`, exactly `near_relief` from `high` on.
std::vector<float> ReliefByGrey(int low, int high, const DepthOptions& options) {
  std::vector<float> relief(kWhite + 1);
  const double furthest = DistanceOf(low, options), nearest = DistanceOf(high, options);
  for (int grey = 0; grey <= kWhite; ++grey) {
    double nearness = 0.0;
    if (grey >= high && high > low)
      nearness = 1.0;
    else if (grey > low && furthest > nearest)
      nearness = (furthest - DistanceOf(grey, options)) / (furthest - nearest);
    relief[grey] = static_cast<float>(options.far_relief +
                                      nearness * (options.near_relief - options.far_relief));
  }
  return relief;
}

DepthMap Apply(const std::vector<float>& relief, const GreyPlane& plane) {
  DepthMap depth(plane.width, plane.height);
  ForStripsOfRows(plane.height, [&](int first, int last) {
    for (std::size_t i = plane.Index(0, first); i < plane.Index(0, last); ++i)
      depth.relief[i] =
          plane.imaged[i] ? relief[plane.grey[i]] : std::numeric_limits<float>::quiet_NaN();
  });
  return depth;
}

// Maps relative distances linearly to the range of relief: exactly `far_relief` from the high
// distance on, exactly `near_relief` up to the low one.
DepthMap ReliefByDistance(const std::vector<float>& distance, const GreyPlane& plane,
                          std::size_t imaged, const DepthOptions& options, DepthReport& report) {
  DepthMap depth(plane.width, plane.height, std::numeric_limits<float>::quiet_NaN());
  if (imaged == 0) return depth;
  std::vector<float> known;
  known.reserve(imaged);
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (plane.imaged[i]) known.push_back(distance[i]);
  // The nearest distance is the lowest, so the percentiles of grey count from the other end.
  const auto at = [&](double percent) {
    const auto rank = static_cast<std::ptrdiff_t>(
        std::clamp(std::floor(percent / 100.0 * static_cast<double>(imaged)), 0.0,
                   static_cast<double>(imaged - 1)));
    std::nth_element(known.begin(), known.begin() + rank, known.end());
    return known[static_cast<std::size_t>(rank)];
  };
  std::vector<float> nearnesses;
  nearnesses.reserve(known.size());
  const float shortest = *std::min_element(known.begin(), known.end());
  for (const float value : known) nearnesses.push_back(shortest / value);
  report.histogram = HistogramOfValues(nearnesses, 1.0);
  float nearest = at(100.0 - options.high_percentile),
        furthest = at(100.0 - options.low_percentile);
  if (nearest == furthest) {
    nearest = at(0.0);
    furthest = at(100.0);
  }
  report.is_flat = !(furthest > nearest * (1 + 1e-5f));  // smoothing leaves a residue of this size
  report.distance_ratio = furthest / nearest;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (!plane.imaged[i]) continue;
    const double nearness =
        report.is_flat ? 0.0
                       : std::clamp((furthest - distance[i]) / (furthest - nearest), 0.0f, 1.0f);
    depth.relief[i] = static_cast<float>(options.far_relief +
                                         nearness * (options.near_relief - options.far_relief));
  }
  return depth;
}

// 1 % of the picture's shorter side, px.
double PercentOf(const GreyPlane& plane) { return 0.01 * std::min(plane.width, plane.height); }

void Taper(DepthMap& depth, const GreyPlane& plane, const DepthOptions& options) {
  TaperToBorder(depth, plane.imaged, options.border_taper * PercentOf(plane));
}

// Grey takes bright tissue for near. The other estimators divide by the tissue's colour, and their
// steps are steps of the light.
void WidenSteps(DepthMap& depth, const GreyPlane& plane, const DepthOptions& options) {
  const double width = options.step_width * PercentOf(plane);
  // A step alone gets half of the steepest slope.
  if (width >= 1.0) LimitSteepness(depth, 2.0 * (options.near_relief - options.far_relief) / width);
}

}  // namespace

void CheckDepthOptions(const DepthOptions& options) {
  CheckOptions(options);
  if (HasEffect(options, "red_weight") &&
      !(options.red_weight + options.green_weight + options.blue_weight > 0.0))
    throw Error(Code::kBadArgument,
                "the weights of red, green and blue are all 0; raise at least one");
  if (!(options.low_percentile < options.high_percentile))
    throw Error(Code::kBadArgument,
                fmt::format("the low percentile, {:g}, must lie below the high one, {:g}",
                            options.low_percentile, options.high_percentile));
  if (!(options.far_relief <= options.near_relief))
    throw Error(Code::kBadArgument,
                fmt::format("far relief, {:g} mm, must not be larger than near relief, {:g} mm: "
                            "relief grows towards the scope",
                            1e3 * options.far_relief, 1e3 * options.near_relief));
}

std::vector<std::uint8_t> FoundHighlights(const ColourImage& panorama,
                                          const DepthOptions& options) {
  if (panorama.empty() || !options.fill_highlights) return {};
  std::vector<std::uint8_t> flags;
  GreyPlane plane = GreyFromColour(panorama, options, flags);
  MaskSurround(plane, flags, options);
  const std::size_t imaged = Count(plane.imaged);
  DepthReport report;
  return imaged > 0 ? HighlightsOf(plane, flags, imaged, report) : std::vector<std::uint8_t>();
}

DepthMap DepthFromColour(const ColourImage& panorama, const DepthOptions& options,
                         DepthReport* report, const Progress& progress,
                         std::span<const DepthMark> marks) {
  CheckDepthOptions(options);
  DepthReport own;
  DepthReport& told = report ? *report : own;
  told = {};
  if (panorama.empty()) return {};

  // Grey of the imaged area.
  progress.Step("grey", 0.0);
  std::vector<std::uint8_t> flags;
  GreyPlane plane = GreyFromColour(panorama, options, flags);
  MaskSurround(plane, flags, options);
  const std::size_t imaged = Count(plane.imaged);
  told.imaged_share = static_cast<double>(imaged) / static_cast<double>(plane.imaged.size());

  // Highlights and noise, which say nothing about depth, are removed.
  progress.Step("highlights", 0.2);
  std::vector<std::uint8_t> highlight;
  if (options.fill_highlights && imaged > 0) highlight = HighlightsOf(plane, flags, imaged, told);
  TakeMarks(marks, plane, highlight);
  if (options.estimator != DepthEstimator::kPaper) {
    DepthMap depth =
        ReliefByDistance(DistanceFromLight(panorama, plane, highlight, options, progress), plane,
                         imaged, options, told);
    Taper(depth, plane, options);
    progress.Step("done", 1.0);
    return depth;
  }
  if (!highlight.empty()) FillHighlights(plane, highlight);
  progress.Step("median", 0.3);
  MaskedMedian(plane, options.median_radius);

  // Normalises the range of greys to the range of relief. All greys count when the percentiles are
  // equal although there is more than one grey.
  progress.Step("normalise", 0.8);
  const Histogram histogram = HistogramOf(plane);
  int low = Percentile(histogram, imaged, options.low_percentile);
  int high = Percentile(histogram, imaged, options.high_percentile);
  if (low == high) {
    low = Percentile(histogram, imaged, 0.0);
    high = Percentile(histogram, imaged, 100.0);
  }
  told.histogram = HistogramOfGreys(histogram);
  told.is_flat = imaged > 0 && low == high;
  told.low_grey = low / 256.0;
  told.high_grey = high / 256.0;
  DepthMap depth = Apply(ReliefByGrey(low, high, options), plane);
  WidenSteps(depth, plane, options);
  Taper(depth, plane, options);
  progress.Step("done", 1.0);
  return depth;
}

}  // namespace arthro::authoring
