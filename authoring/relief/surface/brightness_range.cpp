#include "authoring/relief/surface/brightness_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

#include "authoring/panorama/compose/frame_cells.h"
#include "authoring/panorama/compose/light_model.h"
#include "authoring/panorama/graph/links/parallel.h"
#include "authoring/relief/median.h"
#include "authoring/relief/surface/relief_layout.h"
#include "authoring/relief/surface/surface_view.h"
#include "simulation/core/at.h"
#include "simulation/scene/relief_origin.h"

namespace arthro::authoring {
namespace {

constexpr int kLeastViews = 3;
constexpr double kReach = 0.36;       // to either side of the closed surface, in ln r
constexpr int kTried = 25;            // radii
constexpr double kLeastChange = 0.1;  // rms over the frames, of the change of brightness with ln r
constexpr double kBlur = 3;           // px: the texture that misplaced pixels would show
constexpr double kDarkest = 0.03, kBrightest = 0.94;  // share of white that is read
constexpr int kLeastChecks = 60;   // measured cells that the estimate is compared with
constexpr double kUseless = 0.25;  // ln r: an estimate with a larger error is none
constexpr int kCheckStride = 3;    // cells

std::uint8_t Number(ReliefOrigin origin) { return static_cast<std::uint8_t>(origin); }

// A frame's brightness with camera and light taken out, up to albedo and incident light.
struct LitView {
  const SurfaceView* view = nullptr;
  cv::Mat exposure;  // CV_32FC1, mean e of the channels; NaN where one is dark or overexposed
  double gain = 0;
};

cv::Mat ExposureOf(const cv::Mat& picture, const LightModel& light) {
  cv::Mat smooth;
  cv::GaussianBlur(picture, smooth, {0, 0}, kBlur);
  float table[256];
  for (int grey = 0; grey < 256; ++grey) {
    const double y = grey / 255.0;
    table[grey] =
        y < kDarkest || y > kBrightest ? kUnknownRange : static_cast<float>(light.Exposure(y));
  }
  cv::Mat exposure(picture.size(), CV_32F);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      const auto& c = smooth.at<cv::Vec3b>(y, x);
      exposure.at<float>(y, x) = (table[c[0]] + table[c[1]] + table[c[2]]) / 3;
    }
  return exposure;
}

// The readings of a cell at one radius: brightness without its light model, and incident light.
struct Reading {
  double value = 0, light = 0;  // e - gain - falloff, and t ln(cos / range²)
};

class Estimator {
 public:
  Estimator(const std::vector<LitView>& views, const LensProfile& lens, const SurfaceCells& cells,
            const cv::Mat& radius, const cv::Mat& normals, const LightModel& light)
      : views_(views),
        lens_(lens),
        cells_(cells),
        radius_(radius),
        normals_(normals),
        light_(light) {}

  // Logarithm of the radius and its formal deviation; false where brightness says nothing.
  bool Estimate(int x, int y, const std::vector<int>& seen_by, double noise, double& logarithm,
                double& deviation) const {
    const double middle = std::log(radius_.at<float>(y, x));
    std::vector<double> scores(kTried, 1e9);
    std::vector<Reading> readings;
    int best = -1;
    for (int k = 0; k < kTried; ++k) {
      const double at = middle + kReach * (2.0 * k / (kTried - 1) - 1);
      Read(x, y, seen_by, at, readings);
      if (readings.size() < At(kLeastViews)) continue;
      scores[At(k)] = Residual(readings);
      if (best < 0 || scores[At(k)] < scores[At(best)]) best = k;
    }
    if (best <= 0 || best + 1 >= kTried || scores[At(best - 1)] > 1e8 || scores[At(best + 1)] > 1e8)
      return false;
    const double step = 2 * kReach / (kTried - 1);
    const double bend = scores[At(best - 1)] - 2 * scores[At(best)] + scores[At(best + 1)];
    if (!(bend > 0)) return false;
    const double offset =
        std::clamp(0.5 * (scores[At(best - 1)] - scores[At(best + 1)]) / bend, -0.5, 0.5);
    logarithm = middle + kReach * (2.0 * best / (kTried - 1) - 1) + step * offset;
    // How the incident light of the frames changes apart with the radius.
    const double spread = Spread(x, y, seen_by, logarithm, step);
    if (spread < kLeastChange) return false;
    Read(x, y, seen_by, logarithm, readings);
    const auto n = static_cast<double>(readings.size());
    if (n < kLeastViews) return false;
    const double residual = std::sqrt(Residual(readings) / std::max(1.0, n - 2));
    deviation = std::max(noise, residual) / (spread * std::sqrt(n));
    return true;
  }

  // Root of the mean squared disagreement of the frames about a cell of the surface; -1: too few.
  double Disagreement(int x, int y, const std::vector<int>& seen_by) const {
    std::vector<Reading> readings;
    Read(x, y, seen_by, std::log(radius_.at<float>(y, x)), readings);
    if (readings.size() < At(kLeastViews)) return -1;
    return std::sqrt(Residual(readings) / static_cast<double>(readings.size() - 1));
  }

 private:
  void Read(int x, int y, const std::vector<int>& seen_by, double logarithm,
            std::vector<Reading>& readings) const {
    readings.clear();
    const cv::Vec3f point = cells_.Row(y)[x] * static_cast<float>(std::exp(logarithm));
    const cv::Vec3f& normal = normals_.at<cv::Vec3f>(y, x);
    for (const int v : seen_by) {
      const LitView& lit = views_[At(v)];
      double pixel[2];
      if (!PixelOf(*lit.view, lens_, point, pixel)) continue;
      const float e = lit.exposure.at<float>(static_cast<int>(pixel[1] + 0.5),
                                             static_cast<int>(pixel[0] + 0.5));
      if (std::isnan(e)) continue;
      const cv::Vec3f ray = point - lit.view->centre;
      const double range = cv::norm(ray);
      const cv::Vec3f local = lit.view->camera_from_portal * ray;
      const double cosine = std::max(0.05, -static_cast<double>(normal.dot(ray)) / range);
      const double axial = local[2] / range, u = (1 - axial * axial) / light_.reach;
      const double off_axis =
          light_.falloff[0] * u + light_.falloff[1] * u * u + light_.falloff[2] * u * u * u;
      readings.push_back(
          {e - lit.gain - off_axis, light_.tilt * (std::log(cosine) - 2 * std::log(range))});
    }
  }

  // Sum of the squared disagreement about the albedo, about its median: glints are outliers.
  static double Residual(const std::vector<Reading>& readings) {
    std::vector<double> albedo;
    albedo.reserve(readings.size());
    for (const Reading& reading : readings) albedo.push_back(reading.value - reading.light);
    const double middle = Median(albedo);
    double sum = 0;
    for (double& a : albedo) {
      a = (a - middle) * (a - middle);
      sum += a;
    }
    // Cauchy's weight at thrice the median deviation.
    const double scale = 9 * Median(albedo) + 1e-12;
    sum = 0;
    for (const double square : albedo) sum += scale * std::log1p(square / scale);
    return sum;
  }

  double Spread(int x, int y, const std::vector<int>& seen_by, double logarithm,
                double step) const {
    std::vector<Reading> near, far;
    Read(x, y, seen_by, logarithm - step, near);
    Read(x, y, seen_by, logarithm + step, far);
    if (near.size() != far.size() || near.size() < At(kLeastViews)) return 0;
    double mean = 0, squares = 0;
    for (std::size_t i = 0; i < near.size(); ++i)
      mean += (far[i].light - near[i].light) / (2 * step);
    mean /= static_cast<double>(near.size());
    for (std::size_t i = 0; i < near.size(); ++i) {
      const double off = (far[i].light - near[i].light) / (2 * step) - mean;
      squares += off * off;
    }
    return std::sqrt(squares / static_cast<double>(near.size()));
  }

  const std::vector<LitView>& views_;
  const LensProfile& lens_;
  const SurfaceCells& cells_;
  const cv::Mat &radius_, &normals_;
  const LightModel& light_;
};

}  // namespace

BrightnessRange RangeFromBrightness(const std::vector<SurfaceView>& views,
                                    const std::vector<cv::Mat>& pictures, const LensProfile& lens,
                                    const SurfaceCells& cells, const ClosedSurface& closed,
                                    const std::vector<cv::Mat>& visible, int threads,
                                    const Progress& progress) {
  BrightnessRange found{cv::Mat(cells.size, CV_32F, cv::Scalar(kUnknownRange)),
                        cv::Mat(cells.size, CV_32F, cv::Scalar(kUnknownRange))};
  // The light, from the measured cells only.
  ReliefLayoutRequest request;
  std::vector<cv::Mat> measured;
  const cv::Mat is_measured = closed.origin == Number(ReliefOrigin::kMeasured);
  for (std::size_t v = 0; v < views.size(); ++v) {
    request.indices.push_back(static_cast<int>(v));
    measured.push_back(visible[v] & is_measured);
  }
  const Layout layout = LayOverRelief(views, lens, cells, closed, measured, request);
  if (layout.frames.size() < At(kLeastViews)) return found;
  std::vector<FrameCells> frame_cells(layout.frames.size());
  std::vector<CellRays> rays;
  for (const LaidFrame& frame : layout.frames)
    rays.emplace_back(frame, layout.cell, RectifiedView{});
  ForEachIndex(static_cast<int>(layout.frames.size()), threads, progress, "reading brightness",
               [&](int i) {
                 const auto v = At(layout.frames[At(i)].index);
                 frame_cells[At(i)] = CellsOf(pictures[v], TissueMask(pictures[v], views[v].mask),
                                              views[v].mask, layout.frames[At(i)], layout.cell);
               });
  ComposeOptions options;
  options.light_reach = 0;  // a residue per frame would explain the range away
  const LightModel light = EstimateLight(frame_cells, rays, layout, options, progress);
  if (!(std::abs(light.tilt) > 1e-3)) return found;

  std::vector<LitView> lit(layout.frames.size());
  ForEachIndex(static_cast<int>(lit.size()), threads, progress, "reading brightness", [&](int i) {
    const auto v = At(layout.frames[At(i)].index);
    lit[At(i)] = {&views[v], ExposureOf(pictures[v], light), light.frames[At(i)].gain};
  });
  // Slopes of the membrane itself, however uncertain: the estimate starts from them.
  constexpr double kSmooth = 3;  // cells
  cv::Mat smooth;
  cv::GaussianBlur(closed.radius, smooth, {0, 0}, kSmooth);
  const cv::Mat normals = NormalsOf(cells, smooth);
  const Estimator estimator(lit, lens, cells, closed.radius, normals, light);
  const auto seen_by = [&](int x, int y) {
    std::vector<int> seen;
    for (std::size_t i = 0; i < lit.size(); ++i)
      if (visible[At(layout.frames[i].index)].at<std::uint8_t>(y, x))
        seen.push_back(static_cast<int>(i));
    return seen;
  };

  // The noise of the readings, and then the error of the estimate, on measured cells.
  std::vector<double> noises, misses;
  for (int y = 0; y < cells.size.height; y += kCheckStride)
    for (int x = 0; x < cells.size.width; x += kCheckStride) {
      if (!is_measured.at<std::uint8_t>(y, x)) continue;
      const double noise = estimator.Disagreement(x, y, seen_by(x, y));
      if (noise >= 0) noises.push_back(noise);
    }
  if (noises.size() < At(kLeastChecks)) return found;
  const double noise = Median(noises);
  for (int y = 0; y < cells.size.height; y += kCheckStride)
    for (int x = 0; x < cells.size.width; x += kCheckStride) {
      double logarithm = 0, deviation = 0;
      if (is_measured.at<std::uint8_t>(y, x) &&
          estimator.Estimate(x, y, seen_by(x, y), noise, logarithm, deviation))
        misses.push_back(std::abs(logarithm - std::log(closed.radius.at<float>(y, x))) / deviation);
    }
  if (misses.size() < At(kLeastChecks)) return found;
  constexpr double kMedianOfNormal = 0.6745;
  found.inflation = std::max(1.0, Median(misses) / kMedianOfNormal);

  ForEachIndex(cells.size.height, threads, progress, "range from brightness", [&](int y) {
    for (int x = 0; x < cells.size.width; ++x) {
      if (is_measured.at<std::uint8_t>(y, x)) continue;
      double logarithm = 0, deviation = 0;
      if (!estimator.Estimate(x, y, seen_by(x, y), noise, logarithm, deviation)) continue;
      deviation *= found.inflation;
      const double radius = std::exp(logarithm);
      // It helps only where the membrane knows less.
      if (deviation > kUseless || deviation * radius > closed.sigma.at<float>(y, x)) continue;
      found.radius.at<float>(y, x) = static_cast<float>(radius);
      found.sigma.at<float>(y, x) = static_cast<float>(deviation * radius);
    }
  });
  return found;
}

}  // namespace arthro::authoring
