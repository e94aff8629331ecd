#include "authoring/panorama/compose/light_model.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

namespace arthro::authoring {
namespace {

constexpr int kShared = 6;            // unknowns common to all frames: b, v, t
constexpr double kMostSamples = 6e4;  // number of samples that are used
constexpr int kRounds = 8;            // iterations of reweighting
constexpr double kFieldPrior = 0.02;  // share of a frame's samples: pulls its field to 0
constexpr double kDarkNoise = 0.06;   // share of white: below it the logarithm is mostly noise
constexpr double kTooBright = 0.95;   // share of white: above it a channel may be clipped

// Sample of a cell: dependence of its three channels on the unknowns, and their values.
struct View {
  int frame = 0;
  std::array<double, 4> light;  // u, u^2, u^3, ln w
  std::array<double, 6> field;  // x, y, x^2 - y^2, xy, x^2 + y^2 as in FrameLight, and 1
  std::array<double, 3> y;      // channels, 0 to 1
  double blend_weight = 0;
};

struct Place {
  int first = 0, last = 0;  // range of samples
};

double SquaredSine(const CellRays::Ray& ray) {
  const double squared_tangent = ray.x * ray.x + ray.y * ray.y;
  return squared_tangent / (1 + squared_tangent);
}

std::array<double, 4> LightTerms(const CellRays::Ray& ray, double reach) {
  const double u = SquaredSine(ray) / reach;
  return {u, u * u, u * u * u, std::log(ray.w)};
}

std::array<double, 6> FieldTerms(const CellRays::Ray& ray, double reach) {
  const double norm = std::sqrt((1 + ray.x * ray.x + ray.y * ray.y) * reach);
  const double x = ray.x / norm, y = ray.y / norm;
  return {x, y, x * x - y * y, x * y, x * x + y * y, 1};
}

// Samples by place, on every `stride`-th cell in both directions.
void Gather(const std::vector<FrameCells>& cells, const std::vector<CellRays>& rays,
            const Layout& layout, double& reach, std::vector<View>& views,
            std::vector<Place>& places) {
  double all = 0;
  for (std::size_t f = 0; f < cells.size(); ++f)
    if (cells[f].is_seen()) all += layout.frames[f].cells.area();
  reach = 0;
  for (std::size_t f = 0; f < cells.size(); ++f) {
    const cv::Rect& box = layout.frames[f].cells;
    for (int y = 0; cells[f].is_seen() && y < box.height; y += 2)
      for (int x = 0; x < box.width; x += 2)
        if (cells[f].blend_weight.at<uchar>(y, x) >= 128)
          reach = std::max(reach, SquaredSine(rays[f].At(box.x + x, box.y + y)));
  }
  reach = std::max(reach, 1e-6);
  const int stride = std::max(1, static_cast<int>(std::ceil(std::sqrt(all / kMostSamples))));
  for (int y = stride / 2; y < layout.cells.height; y += stride)
    for (int x = stride / 2; x < layout.cells.width; x += stride) {
      const int first = static_cast<int>(views.size());
      for (std::size_t f = 0; f < cells.size(); ++f) {
        const cv::Rect& box = layout.frames[f].cells;
        if (!cells[f].is_seen() || !box.contains({x, y})) continue;
        const int blend_weight = cells[f].blend_weight.at<uchar>(y - box.y, x - box.x);
        if (blend_weight < 128) continue;
        const auto& colour = cells[f].colour.at<cv::Vec3w>(y - box.y, x - box.x);
        View view;
        view.frame = static_cast<int>(f);
        const CellRays::Ray ray = rays[f].At(x, y);
        view.light = LightTerms(ray, reach);
        view.field = FieldTerms(ray, reach);
        for (int c = 0; c < 3; ++c) view.y[c] = std::max(1.0, colour[c] / kGreySteps) / 255.0;
        view.blend_weight = blend_weight / 255.0;
        views.push_back(view);
      }
      const int last = static_cast<int>(views.size());
      if (last - first >= 2)
        places.push_back({first, last});
      else
        views.resize(first);
    }
}

// Weight of a channel: low in the dark and near clipping. The last factor measures residuals in
// grey levels; without it, flattening e would explain everything.
double Trust(double y, const std::array<double, 2>& b) {
  const double dark = y / (y + kDarkNoise);
  const double bright = std::clamp((kTooBright - y) / 0.08, 0.0, 1.0);
  const double slope = 1 + 2 * b[0] * y * y + 6 * b[1] * std::pow(y, 6);
  return dark * dark * bright / (slope * slope);
}

class Solver {
 public:
  Solver(const std::vector<View>& views, const std::vector<Place>& places, LightModel& light,
         const ComposeOptions& options)
      : views_(views), places_(places), light_(light), options_(options) {}

  // One weighted least-squares step on the common unknowns and the gains. Eliminates each place's
  // brightness by subtracting the weighted mean of its samples.
  void SolveShared(double sigma) {
    const int n = static_cast<int>(light_.frames.size());
    Eigen::Matrix<double, kShared, kShared> shared = decltype(shared)::Zero();
    Eigen::Matrix<double, kShared, 1> shared_right = decltype(shared_right)::Zero();
    Eigen::MatrixXd mixed = Eigen::MatrixXd::Zero(n, kShared);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n), diagonal = Eigen::VectorXd::Zero(n);
    std::unordered_map<std::uint64_t, double> pairs;
    std::vector<double> weight, left;
    std::vector<Eigen::Matrix<double, kShared, 1>> rows;
    for (const Place& place : places_)
      for (int c = 0; c < 3; ++c) {
        const int m = place.last - place.first;
        weight.assign(m, 0);
        left.assign(m, 0);
        rows.resize(m);
        Weigh(place, c, sigma, weight);
        double sum = 0, mean_left = 0;
        Eigen::Matrix<double, kShared, 1> mean = decltype(mean)::Zero();
        for (int i = 0; i < m; ++i) {
          const View& view = views_[place.first + i];
          rows[i] << std::pow(view.y[c], 2), std::pow(view.y[c], 6), -view.light[0], -view.light[1],
              -view.light[2], -view.light[3];
          left[i] = std::log(view.y[c]) - FieldOf(view);
          sum += weight[i];
          mean += weight[i] * rows[i];
          mean_left += weight[i] * left[i];
        }
        if (sum < 1e-6) continue;
        mean /= sum;
        mean_left /= sum;
        for (int i = 0; i < m; ++i) {
          if (weight[i] < 1e-6) continue;
          const int f = views_[place.first + i].frame;
          const Eigen::Matrix<double, kShared, 1> row = rows[i] - mean;
          const double value = left[i] - mean_left;
          shared += weight[i] * row * row.transpose();
          shared_right -= weight[i] * value * row;
          mixed.row(f) -= weight[i] * row.transpose();
          right[f] += weight[i] * value;
          diagonal[f] += weight[i];
          for (int j = 0; j < m; ++j) {
            const int g = views_[place.first + j].frame;
            if (g >= f && weight[j] >= 1e-6)
              pairs[static_cast<std::uint64_t>(f) * n + g] -= weight[i] * weight[j] / sum;
          }
        }
      }

    // Weak priors, so that unknowns that the overlaps do not determine stay 0.
    const double data = std::max(1.0, diagonal.sum());
    const double bend = options_.estimate_response ? 1e-3 * data : 1e6 * data;
    shared.diagonal() += Eigen::Matrix<double, kShared, 1>(bend, bend, 3e-5 * data, 3e-5 * data,
                                                           3e-5 * data, 3e-5 * data);
    diagonal.array() += 1e-8 * data / n;  // fixes the common level of the gains

    // Eliminates the gains by sparse Cholesky, then solves the few common unknowns by the Schur
    // complement.
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& [key, value] : pairs) {
      const int f = static_cast<int>(key / n), g = static_cast<int>(key % n);
      entries.emplace_back(g, f, value);
    }
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
      return std::pair(a.col(), a.row()) < std::pair(b.col(), b.row());
    });
    for (int f = 0; f < n; ++f) entries.emplace_back(f, f, diagonal[f]);
    Eigen::SparseMatrix<double> gains(n, n);
    gains.setFromTriplets(entries.begin(), entries.end());
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(gains);
    if (factor.info() != Eigen::Success) return;
    const Eigen::MatrixXd from_shared = factor.solve(mixed);
    const Eigen::VectorXd alone = factor.solve(right);
    const Eigen::Matrix<double, kShared, kShared> reduced =
        shared - mixed.transpose() * from_shared;
    const Eigen::Matrix<double, kShared, 1> p =
        reduced.ldlt().solve(shared_right - mixed.transpose() * alone);
    if (!p.allFinite()) return;
    const Eigen::VectorXd g = alone - from_shared * p;
    light_.response = {std::clamp(p[0], 0.0, 2.0), std::clamp(p[1], 0.0, 2.0)};
    light_.falloff = {p[2], p[3], p[4]};
    light_.tilt = p[5];
    for (int f = 0; f < n; ++f) light_.frames[f].gain = g[f];
  }

  // Low-frequency residue of each frame against the mean of all.
  void SolveFields(double sigma) {
    const int n = static_cast<int>(light_.frames.size());
    using Matrix6 = Eigen::Matrix<double, 6, 6>;
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    std::vector<Matrix6> normal(n, Matrix6::Zero());
    std::vector<Vector6> right(n, Vector6::Zero());
    std::vector<double> weight;
    for (const Place& place : places_)
      for (int c = 0; c < 3; ++c) {
        weight.assign(place.last - place.first, 0);
        const double mean = Weigh(place, c, sigma, weight);
        for (std::size_t i = 0; i < weight.size(); ++i) {
          const View& view = views_[place.first + i];
          const Eigen::Map<const Vector6> row(view.field.data());
          normal[view.frame] += weight[i] * row * row.transpose();
          right[view.frame] += weight[i] * (Reading(view, c) - mean) * row;
        }
      }
    for (int f = 0; f < n; ++f) {
      Matrix6 own = normal[f];
      const double stiff = own(5, 5) / options_.light_reach;
      if (stiff < 1e-6) continue;
      own.diagonal().array() += kFieldPrior * stiff;
      Vector6 pull = right[f];
      for (int k = 0; k < 5; ++k) pull[k] -= kFieldPrior * stiff * light_.frames[f].field[k];
      const Vector6 step = own.ldlt().solve(pull);
      if (!step.allFinite()) continue;
      for (int k = 0; k < 5; ++k) light_.frames[f].field[k] += step[k];
      light_.frames[f].gain += step[5];
    }
  }

  // Gives the panorama the brightness of the frames' middles.
  void SetLevel() {
    std::vector<double> raw;
    for (const View& view : views_)
      if (view.light[0] < 0.25) raw.push_back(light_.Exposure(view.y[1]) - Reading(view, 1));
    if (raw.empty())
      for (const View& view : views_) raw.push_back(light_.Exposure(view.y[1]) - Reading(view, 1));
    if (raw.empty()) return;
    std::nth_element(raw.begin(), raw.begin() + raw.size() / 2, raw.end());
    light_.level = raw[raw.size() / 2];
  }

 private:
  double FieldOf(const View& view) const {
    double sum = 0;
    for (int k = 0; k < 5; ++k) sum += light_.frames[view.frame].field[k] * view.field[k];
    return sum;
  }
  double Reading(const View& view, int c) const {
    double e = light_.Exposure(view.y[c]) - light_.frames[view.frame].gain - FieldOf(view) -
               light_.tilt * view.light[3];
    for (int k = 0; k < 3; ++k) e -= light_.falloff[k] * view.light[k];
    return e;
  }
  // Robust weights of a place's samples in a channel, and their weighted mean.
  double Weigh(const Place& place, int c, double sigma, std::vector<double>& weight) const {
    double mean = 0;
    for (int round = 0; round < 3; ++round) {
      double sum = 0, all = 0;
      for (int i = place.first; i < place.last; ++i) {
        const double r = (Reading(views_[i], c) - mean) / sigma;
        const double robust = round == 0 ? 1 : 1 / ((1 + r * r) * (1 + r * r));
        const double w = robust * views_[i].blend_weight * Trust(views_[i].y[c], light_.response);
        weight[i - place.first] = w;
        sum += w;
        all += w * Reading(views_[i], c);
      }
      mean = sum > 1e-9 ? all / sum : 0;
    }
    return mean;
  }

  const std::vector<View>& views_;
  const std::vector<Place>& places_;
  LightModel& light_;
  const ComposeOptions& options_;
};

}  // namespace

double LightModel::Exposure(double y) const {
  const double square = y * y;
  return std::log(y) + response[0] * square + response[1] * square * square * square;
}

double LightModel::Excess(int f, const CellRays::Ray& ray) const {
  const auto light = LightTerms(ray, reach);
  const auto field = FieldTerms(ray, reach);
  double e = frames[f].gain + tilt * light[3] - level;
  for (int k = 0; k < 3; ++k) e += falloff[k] * light[k];
  for (int k = 0; k < 5; ++k) e += frames[f].field[k] * field[k];
  return e;
}

ToneCurve::ToneCurve(const LightModel& light) : linear_(256), grey_(kSteps + 2) {
  const auto linear_of = [&](double grey) {
    return std::exp(light.Exposure(std::max(grey, 0.25) / 255.0));
  };
  for (int grey = 0; grey < 256; ++grey) linear_[grey] = static_cast<float>(linear_of(grey));
  linear_[0] = 0;
  largest_ = static_cast<float>(linear_of(300));
  // Inverse by walking along the curve, with linear interpolation from each step to the next.
  double grey = 0;
  for (int i = 0; i <= kSteps + 1; ++i) {
    const double wanted = static_cast<double>(largest_) * i / kSteps;
    while (grey < 320 && linear_of(grey + 0.05) <= wanted) grey += 0.05;
    const double below = linear_of(grey), above = linear_of(grey + 0.05);
    grey_[i] = static_cast<float>(
        i == 0 ? 0 : grey + 0.05 * std::clamp((wanted - below) / (above - below), 0.0, 1.0));
  }
}

float ToneCurve::Linear(double grey) const {
  const int below = std::clamp(static_cast<int>(grey), 0, 254);
  const float t = static_cast<float>(std::min(grey, 255.0)) - static_cast<float>(below);
  return linear_[below] + t * (linear_[below + 1] - linear_[below]);
}

float ToneCurve::Grey(float linear) const {
  const float at = std::clamp(linear / largest_, 0.f, 1.f) * kSteps;
  const int below = static_cast<int>(at);
  return grey_[below] + (at - static_cast<float>(below)) * (grey_[below + 1] - grey_[below]);
}

LightModel EstimateLight(const std::vector<FrameCells>& cells, const std::vector<CellRays>& rays,
                         const Layout& layout, const ComposeOptions& options,
                         const Progress& progress) {
  LightModel light;
  light.frames.resize(cells.size());
  if (!options.even_light) return light;
  std::vector<View> views;
  std::vector<Place> places;
  Gather(cells, rays, layout, light.reach, views, places);
  if (places.empty()) return light;
  Solver solver(views, places, light, options);
  double sigma = 1.0;
  for (int round = 0; round < kRounds; ++round) {
    progress.Step("even light", static_cast<double>(round) / kRounds);
    solver.SolveShared(sigma);
    sigma = std::max(0.08, sigma * 0.6);
  }
  if (options.light_reach > 0)
    for (int round = 0; round < kRounds; ++round) {
      progress.Step("even light", static_cast<double>(round) / kRounds);
      solver.SolveFields(sigma);
    }
  solver.SetLevel();
  return light;
}

void EvenLight(FrameCells& cells, const CellRays& rays, const cv::Rect& box,
               const LightModel& light, int f, const ToneCurve& tone) {
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x) {
      if (cells.blend_weight.at<uchar>(y, x) == 0) continue;
      auto& colour = cells.colour.at<cv::Vec3w>(y, x);
      const float gain =
          static_cast<float>(std::exp(-light.Excess(f, rays.At(box.x + x, box.y + y))));
      for (int c = 0; c < 3; ++c)
        colour[c] = cv::saturate_cast<ushort>(
            kGreySteps * tone.Grey(gain * tone.Linear(colour[c] / kGreySteps)));
    }
}

}  // namespace arthro::authoring
