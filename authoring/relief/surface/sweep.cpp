#include "authoring/relief/surface/sweep.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "authoring/panorama/graph/links/parallel.h"
#include "authoring/relief/surface/semi_global.h"
#include "authoring/relief/surface/surface_view.h"
#include "simulation/core/at.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr int kLeastFrames = 3;      // least number of frames that see a cell
constexpr double kFurthest = 80;     // degrees from the axis of the portal frame
constexpr float kLeastShare = 0.6f;  // share of a window's cells that a frame must see
constexpr float kNoise = 4.0f;       // grey levels; windows with less contrast count less

float Sample(const cv::Mat& picture, const double* pixel) {
  const int x = static_cast<int>(pixel[0]), y = static_cast<int>(pixel[1]);
  const float fx = static_cast<float>(pixel[0] - x), fy = static_cast<float>(pixel[1] - y);
  const float *top = picture.ptr<float>(y) + x, *low = picture.ptr<float>(y + 1) + x;
  return (1 - fy) * ((1 - fx) * top[0] + fx * top[1]) + fy * ((1 - fx) * low[0] + fx * low[1]);
}

// A picture with its local mean and contrast taken out, 0 where it is not seen.
struct Normalised {
  cv::Mat value, weight;  // weight: 1 where enough of the window is seen
};

Normalised NormalisedView(const SurfaceView& view, const LensProfile& lens,
                          const SurfaceCells& cells, const cv::Mat& radius, int window) {
  cv::Mat value(cells.size, CV_32F), seen(cells.size, CV_32F);
  for (int y = 0; y < cells.size.height; ++y) {
    const float* r = radius.ptr<float>(y);
    float *v = value.ptr<float>(y), *s = seen.ptr<float>(y);
    const cv::Vec3f* d = &cells.directions[At(y) * At(cells.size.width)];
    for (int x = 0; x < cells.size.width; ++x) {
      double pixel[2];
      const bool is_seen = r[x] > 0 && PixelOf(view, lens, d[x] * r[x], pixel);
      s[x] = is_seen ? 1.0f : 0.0f;
      v[x] = is_seen ? Sample(view.grey, pixel) - 128.0f : 0.0f;
    }
  }
  cv::Mat count, sum, squares;
  const cv::Size box(window, window);
  const auto add = [&](const cv::Mat& from, cv::Mat& to) {
    cv::boxFilter(from, to, CV_32F, box, {-1, -1}, false, cv::BORDER_CONSTANT);
  };
  add(seen, count);
  add(value, sum);
  add(value.mul(value), squares);
  Normalised out{cv::Mat::zeros(cells.size, CV_32F), cv::Mat::zeros(cells.size, CV_32F)};
  const float least = kLeastShare * static_cast<float>(window * window);
  for (int y = 0; y < cells.size.height; ++y)
    for (int x = 0; x < cells.size.width; ++x) {
      const float n = count.at<float>(y, x);
      if (n < least || seen.at<float>(y, x) == 0) continue;
      const float mean = sum.at<float>(y, x) / n;
      const float power = std::max(0.0f, squares.at<float>(y, x) / n - mean * mean);
      out.weight.at<float>(y, x) = 1;
      out.value.at<float>(y, x) =
          (value.at<float>(y, x) - mean) / std::sqrt(power + kNoise * kNoise);
    }
  return out;
}

// Correlation of every view with the mean of the others, over the window; 0 where a view or the
// others see nothing. `sum` and `count` are over all views.
cv::Mat CorrelationOf(const Normalised& view, const cv::Mat& sum, int window) {
  const cv::Mat others = (sum - view.value).mul(view.weight);
  cv::Mat product, own, theirs;
  const cv::Size box(window, window);
  const auto add = [&](const cv::Mat& from, cv::Mat& to) {
    cv::boxFilter(from, to, CV_32F, box, {-1, -1}, false, cv::BORDER_CONSTANT);
  };
  add(view.value.mul(others), product);
  add(view.value.mul(view.value), own);
  add(others.mul(others), theirs);
  cv::Mat power = own.mul(theirs), root;
  cv::sqrt(power, root);
  cv::Mat correlation = product / (root + 1e-3f);
  return correlation.mul(view.weight);
}

// Agreement of the frames for one radius of every cell: mean of the better half; -1 where fewer
// than three see it. Gives up early once the job is to stop.
cv::Mat Agreement(const std::vector<SurfaceView>& views, const LensProfile& lens,
                  const SurfaceCells& cells, const cv::Mat& radius, int window,
                  const Progress& progress) {
  std::vector<Normalised> all;
  all.reserve(views.size());
  cv::Mat sum = cv::Mat::zeros(cells.size, CV_32F);
  for (const SurfaceView& view : views) {
    if (progress.ShouldStop()) return {};
    all.push_back(NormalisedView(view, lens, cells, radius, window));
    sum += all.back().value;
  }
  std::vector<cv::Mat> correlations;
  correlations.reserve(views.size());
  for (const Normalised& view : all) {
    if (progress.ShouldStop()) return {};
    correlations.push_back(CorrelationOf(view, sum, window));
  }
  cv::Mat score(cells.size, CV_32F, cv::Scalar(-1));
  std::vector<float> values(views.size());
  for (int y = 0; y < cells.size.height; ++y)
    for (int x = 0; x < cells.size.width; ++x) {
      std::size_t n = 0;
      for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].weight.at<float>(y, x) > 0) values[n++] = correlations[i].at<float>(y, x);
      if (n < static_cast<std::size_t>(kLeastFrames)) continue;
      const std::size_t half = std::max<std::size_t>(2, (n + 1) / 2);
      std::partial_sort(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(half),
                        values.begin() + static_cast<std::ptrdiff_t>(n), std::greater<>());
      float total = 0;
      for (std::size_t i = 0; i < half; ++i) total += values[i];
      score.at<float>(y, x) = total / static_cast<float>(half);
    }
  return score;
}

// One round: scores of every layer, and the smooth surface through them.
struct Round {
  std::vector<cv::Mat> scores;
  LayerChoice choice;
};

Round RunRound(const std::vector<SurfaceView>& views, const LensProfile& lens,
               const SurfaceCells& cells, const std::vector<cv::Mat>& radii, int window,
               const ReliefOptions& options, const Progress& progress, const char* stage) {
  Round round;
  round.scores.resize(radii.size());
  ForEachIndex(static_cast<int>(radii.size()), options.threads, progress, stage, [&](int k) {
    round.scores[At(k)] = Agreement(views, lens, cells, radii[At(k)], window, progress);
  });
  progress.Step(stage, 1);
  round.choice = ChooseLayers(round.scores);
  return round;
}

// Radius of a layer that lies between two.
cv::Mat RadiusOf(const LayerChoice& choice, const std::vector<cv::Mat>& radii) {
  cv::Mat radius(choice.layer.size(), CV_32F, cv::Scalar(kUnknownRange));
  const float last = static_cast<float>(radii.size() - 1);
  for (int y = 0; y < radius.rows; ++y)
    for (int x = 0; x < radius.cols; ++x) {
      const float layer = choice.layer.at<float>(y, x);
      if (!(layer >= 0)) continue;
      const float at = std::clamp(layer, 0.0f, last);
      const int low = std::min(static_cast<int>(at), static_cast<int>(radii.size()) - 2);
      const float share = at - static_cast<float>(low);
      const float a = radii[At(low)].at<float>(y, x), b = radii[At(low + 1)].at<float>(y, x);
      radius.at<float>(y, x) = 1 / ((1 - share) / a + share / b);
    }
  return radius;
}

// Median of a surface with holes, by 5 x 5 cells.
cv::Mat Cleaned(const cv::Mat& radius) {
  cv::Mat out = radius.clone();
  std::vector<float> around;
  for (int y = 0; y < radius.rows; ++y)
    for (int x = 0; x < radius.cols; ++x) {
      if (!(radius.at<float>(y, x) > 0)) continue;
      around.clear();
      for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
          const int i = y + dy, j = x + dx;
          if (i < 0 || j < 0 || i >= radius.rows || j >= radius.cols) continue;
          if (const float r = radius.at<float>(i, j); r > 0) around.push_back(r);
        }
      const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
      std::nth_element(around.begin(), middle, around.end());
      out.at<float>(y, x) = *middle;
    }
  return out;
}

// Smooth surface without holes, on a grid of another size, as the base of the next round.
cv::Mat BaseOf(const cv::Mat& radius, const cv::Size& size, double smoothing) {
  cv::Mat known = radius == radius, value = radius.clone(), weight, blurred;
  value.setTo(0, ~known);
  known.convertTo(weight, CV_32F, 1.0 / 255);
  // Wider and wider, until every cell has a value.
  cv::Mat filled = cv::Mat::zeros(radius.size(), CV_32F),
          left(radius.size(), CV_8U, cv::Scalar(255));
  for (double sigma = smoothing; cv::countNonZero(left) > 0 && sigma < 4 * radius.cols;
       sigma *= 3) {
    cv::Mat w;
    cv::GaussianBlur(value, blurred, {0, 0}, sigma);
    cv::GaussianBlur(weight, w, {0, 0}, sigma);
    const cv::Mat enough = (w > 0.02) & left;
    cv::Mat quotient = blurred / cv::max(w, 1e-6);
    quotient.copyTo(filled, enough);
    left.setTo(0, enough);
  }
  // Across a step the blur is a ramp, from which the few layers of the next round reach neither
  // side: there the surface stays as it is.
  constexpr double kStep = 0.02;  // share of the radius
  const cv::Mat cleaned = Cleaned(radius);
  const cv::Mat is_step = known & (cv::abs(cleaned - filled) > kStep * filled);
  cleaned.copyTo(filled, is_step);
  cv::Mat base;
  cv::resize(filled, base, size, 0, 0, cv::INTER_LINEAR);
  return base;
}

// Share of the views that agree with the surface: a view agrees where it correlates best within
// 1 px of the place that the surface gives, along its own direction of parallax.
cv::Mat ViewAgreement(const std::vector<SurfaceView>& views, const LensProfile& lens,
                      const SurfaceCells& cells, const cv::Mat& radius, int window,
                      const ReliefOptions& options, const Progress& progress) {
  constexpr int kReach = 3;  // px to either side
  std::vector<Normalised> all(views.size());
  ForEachIndex(
      static_cast<int>(views.size()), options.threads, progress, "checking the surface",
      [&](int i) { all[At(i)] = NormalisedView(views[At(i)], lens, cells, radius, window); });
  cv::Mat sum = cv::Mat::zeros(cells.size, CV_32F);
  for (const Normalised& view : all) sum += view.value;
  std::vector<cv::Mat> agrees(views.size()), counts(views.size());
  ForEachIndex(static_cast<int>(views.size()), options.threads, progress, "checking the surface",
               [&](int i) {
                 const SurfaceView& view = views[At(i)];
                 // Change of radius that moves the point by one pixel in this view; 0 where it
                 // hardly moves.
                 cv::Mat step = cv::Mat::zeros(cells.size, CV_32F);
                 constexpr float kSmall = 0.01f, kLeastMove = 0.2f;  // share of the radius; px
                 for (int y = 0; y < cells.size.height; ++y)
                   for (int x = 0; x < cells.size.width; ++x) {
                     const float r = radius.at<float>(y, x);
                     if (!(r > 0)) continue;
                     const cv::Vec3f& d = cells.directions[At(y) * At(cells.size.width) + At(x)];
                     double here[2], there[2];
                     if (!PixelOf(view, lens, d * r, here) ||
                         !PixelOf(view, lens, d * (r * (1 + kSmall)), there))
                       continue;
                     const double move = std::hypot(there[0] - here[0], there[1] - here[1]);
                     if (move > kLeastMove)
                       step.at<float>(y, x) = static_cast<float>(r * kSmall / move);
                   }
                 cv::Mat best(cells.size, CV_32F, cv::Scalar(-2)),
                     offset(cells.size, CV_32F, cv::Scalar(kReach + 1));
                 for (int k = -kReach; k <= kReach; ++k) {
                   if (progress.ShouldStop()) return;
                   cv::Mat moved = radius + step * static_cast<double>(k);
                   Normalised shifted =
                       k == 0 ? all[At(i)] : NormalisedView(view, lens, cells, moved, window);
                   // Against the others at the surface itself.
                   const cv::Mat others_and_shifted = sum - all[At(i)].value + shifted.value;
                   const cv::Mat correlation = CorrelationOf(shifted, others_and_shifted, window);
                   const cv::Mat is_better = correlation > best;
                   correlation.copyTo(best, is_better);
                   offset.setTo(std::abs(k), is_better);
                 }
                 constexpr double kLeastCorrelation = 0.2;
                 cv::Mat counted = (step > 0) & (all[At(i)].weight > 0);
                 cv::Mat good = counted & (offset <= 1) & (best > kLeastCorrelation);
                 good.convertTo(agrees[At(i)], CV_32F, 1.0 / 255);
                 counted.convertTo(counts[At(i)], CV_32F, 1.0 / 255);
               });
  progress.Step("checking the surface", 1);
  cv::Mat good = cv::Mat::zeros(cells.size, CV_32F), total = cv::Mat::zeros(cells.size, CV_32F);
  for (std::size_t i = 0; i < views.size(); ++i) {
    good += agrees[i];
    total += counts[i];
  }
  return good / cv::max(total, 1);
}

// How many views see each cell at its radius, from how far, and the largest angle between their
// rays.
void MeasureParallax(const std::vector<SurfaceView>& views, const LensProfile& lens,
                     const SurfaceCells& cells, SweptSurface& surface) {
  surface.parallax = cv::Mat::zeros(cells.size, CV_32F);
  surface.range = cv::Mat::zeros(cells.size, CV_32F);
  surface.seen_by = cv::Mat::zeros(cells.size, CV_32F);
  std::vector<cv::Vec3f> rays;
  for (int y = 0; y < cells.size.height; ++y)
    for (int x = 0; x < cells.size.width; ++x) {
      const float r = surface.radius.at<float>(y, x);
      if (!(r > 0)) continue;
      const cv::Vec3f point = cells.directions[At(y) * At(cells.size.width) + At(x)] * r;
      rays.clear();
      float ranges = 0;
      for (const SurfaceView& view : views) {
        double pixel[2];
        if (!PixelOf(view, lens, point, pixel)) continue;
        const cv::Vec3f ray = point - view.centre;
        const float range = static_cast<float>(cv::norm(ray));
        ranges += range;
        rays.push_back(ray / range);
      }
      if (rays.empty()) continue;
      float least = 1;
      for (std::size_t i = 0; i < rays.size(); ++i)
        for (std::size_t j = i + 1; j < rays.size(); ++j)
          least = std::min(least, rays[i].dot(rays[j]));
      surface.parallax.at<float>(y, x) = std::acos(std::clamp(least, -1.0f, 1.0f));
      surface.range.at<float>(y, x) = ranges / static_cast<float>(rays.size());
      surface.seen_by.at<float>(y, x) = static_cast<float>(rays.size());
    }
}

// Smallest and largest radius of the measured points, with room to either side.
std::pair<double, double> RadiusRange(const Reconstruction& scene) {
  std::vector<double> radii;
  for (const TrackPoint& point : scene.points)
    if (std::count(point.uses.begin(), point.uses.end(), true) >= 3)
      radii.push_back(point.position.norm());
  if (radii.size() < 10) return {0, 0};
  std::sort(radii.begin(), radii.end());
  const auto at = [&](double share) {
    return radii[static_cast<std::size_t>(share * static_cast<double>(radii.size() - 1))];
  };
  return {0.8 * at(0.02), 1.25 * at(0.98)};
}

// The part of the sphere that three frames see at some radius of the range, as a grid.
SurfaceCells CellsInView(const std::vector<SurfaceView>& views, const LensProfile& lens,
                         double nearest, double furthest, double px_per_deg) {
  const int side = 2 * static_cast<int>(std::ceil(kFurthest * px_per_deg)) + 1;
  Projection projection{
      ProjectionType::kEquirectangular, {0.5 * (side - 1), 0.5 * (side - 1)}, 1000, px_per_deg};
  constexpr int kStride = 2;  // cells
  int left = side, right = -1, top = side, bottom = -1;
  for (int y = 0; y < side; y += kStride)
    for (int x = 0; x < side; x += kStride) {
      const glm::dvec3 d = DirectionFromPixel(projection, {x, y});
      if (d.z < std::cos(RadiansFromDegrees(kFurthest))) continue;
      for (const double share : {0.2, 0.5, 0.8}) {
        const double r = nearest + share * (furthest - nearest);
        const cv::Vec3f point(static_cast<float>(d.x * r), static_cast<float>(d.y * r),
                              static_cast<float>(d.z * r));
        double pixel[2];
        const auto seen = std::count_if(views.begin(), views.end(), [&](const SurfaceView& view) {
          return PixelOf(view, lens, point, pixel);
        });
        if (seen < kLeastFrames) continue;
        left = std::min(left, x), right = std::max(right, x);
        top = std::min(top, y), bottom = std::max(bottom, y);
        break;
      }
    }
  if (right < left) return {};
  // Even sizes, so that the coarse grid has whole cells of two.
  const int width = (right - left + 4) & ~1, height = (bottom - top + 4) & ~1;
  projection.centre_px.x -= left - 1;
  projection.centre_px.y -= top - 1;
  return CellDirections(projection, {width, height});
}

}  // namespace

SweptSurface SweepSurface(const std::vector<WorkingFrame>& frames, const LensProfile& lens,
                          const Reconstruction& scene, const ReliefOptions& options,
                          const Progress& progress) {
  SweptSurface surface;
  const auto [nearest, furthest] = RadiusRange(scene);
  if (!(nearest > 0)) return surface;
  const std::vector<SurfaceView> views = ViewsOf(frames, scene, 0);
  const double px_per_deg = 1 / DegreesFromRadians(options.cell);
  const SurfaceCells cells = CellsInView(views, lens, nearest, furthest, px_per_deg);
  if (cells.size.empty()) return surface;

  // Layers even in the inverse distance from a point between the portal and the tips.
  std::vector<double> insertions;
  for (const auto& pose : scene.poses)
    if (pose) insertions.push_back(pose->centre.norm());
  std::sort(insertions.begin(), insertions.end());
  const double origin = std::min(0.7 * insertions[insertions.size() / 2], 0.6 * nearest);
  const auto radius_at = [origin, near = nearest, far = furthest](double share) {
    return origin + 1 / ((1 - share) / (far - origin) + share / (near - origin));
  };

  // First round: coarse cells, all radii.
  Projection half = cells.projection;
  half.px_per_deg /= 2;
  half.centre_px.x = 0.5 * (half.centre_px.x - 0.5);
  half.centre_px.y = 0.5 * (half.centre_px.y - 0.5);
  const SurfaceCells coarse = CellDirections(half, {cells.size.width / 2, cells.size.height / 2});
  std::vector<cv::Mat> radii;
  radii.reserve(static_cast<std::size_t>(options.layers));
  for (int k = 0; k < options.layers; ++k)
    radii.emplace_back(coarse.size, CV_32F, cv::Scalar(radius_at(k / (options.layers - 1.0))));
  const Round first = RunRound(ViewsOf(frames, scene, 2.0), lens, coarse, radii, 5, options,
                               progress, "trying all radii");
  cv::Mat radius = Cleaned(RadiusOf(first.choice, radii));

  // Two more rounds about the surface found, finer and finer; it follows the tissue's slant.
  Round last;
  for (const auto& [reach, layers, smoothing] :
       {std::tuple(2.5, 17, 1.0), std::tuple(0.8, 11, 0.6)}) {
    const cv::Mat base = BaseOf(radius, cells.size, radius.size() == cells.size ? 1.5 : 1.0);
    const double step = (1 / (nearest - origin) - 1 / (furthest - origin)) / (options.layers - 1);
    radii.clear();
    for (int k = 0; k < layers; ++k) {
      const double shift = step * reach * (2.0 * k / (layers - 1) - 1);
      cv::Mat layer(cells.size, CV_32F);
      for (int y = 0; y < layer.rows; ++y)
        for (int x = 0; x < layer.cols; ++x) {
          const double inverse = 1 / (base.at<float>(y, x) - origin) + shift;
          layer.at<float>(y, x) = static_cast<float>(origin + 1 / std::max(inverse, 1e-6));
        }
      radii.push_back(layer);
    }
    last = RunRound(ViewsOf(frames, scene, smoothing), lens, cells, radii, 7, options, progress,
                    "refining the surface");
    radius = RadiusOf(last.choice, radii);
  }

  // The best radius of a cell is none where it is the first or the last that was tried.
  cv::Mat is_inside = (first.choice.layer > 0.6) & (first.choice.layer < options.layers - 1.6);
  cv::resize(is_inside, is_inside, cells.size, 0, 0, cv::INTER_NEAREST);
  surface.projection = cells.projection;
  surface.radius = radius;
  surface.peak = last.choice.score;
  cv::resize(first.choice.margin, surface.margin, cells.size, 0, 0, cv::INTER_LINEAR);
  cv::resize(first.choice.steadiness, surface.steadiness, cells.size, 0, 0, cv::INTER_LINEAR);
  MeasureParallax(views, lens, cells, surface);
  surface.agreement =
      ViewAgreement(ViewsOf(frames, scene, 1.0), lens, cells, radius, 9, options, progress);
  surface.agreement.setTo(0, ~is_inside);
  surface.peak.setTo(0, ~is_inside);
  surface.radius.setTo(kUnknownRange, surface.seen_by < kLeastFrames);
  return surface;
}

}  // namespace arthro::authoring
