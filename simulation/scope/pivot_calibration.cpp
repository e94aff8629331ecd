#include "simulation/scope/pivot_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "simulation/core/units.h"

namespace arthro::simulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kShortestRod = 1e-6;  // m; a shorter one has no direction
constexpr double kOutlier = 4.0;       // sigmas; Gaussian noise exceeds it once in 3000 presses
constexpr int kFewestForOutliers = 5;  // presses; with four, two pairs could each be right

// Multiple of the squared scatter of directions that angle noise causes about two axes. Nearly
// parallel rods seen through noise turn about the hand, which then looks like the incision. With
// two presses noise alone does this once in e⁸ = 3000 cases, with more almost never.
constexpr double kLeastScatter = 8.0;

constexpr std::size_t kManyLines = 2000;  // lines; above this number, not all pairs are compared

struct Line {
  Vector3d hand, direction;  // unit, from hand to tip
  double length;             // hand to tip, m
  int press;
};
using Lines = std::vector<Line>;

struct Noise {
  double position, angle;  // m, rad

  double At(double reach) const { return std::hypot(position, reach * angle); }
};

struct Fit {
  Vector3d pivot = Vector3d::Zero();
  Matrix3d information = Matrix3d::Zero();  // inverse covariance for the stated noise
  bool solved = false;
};

Lines UsableLines(std::span<const PivotPress> presses, std::vector<int>& left_out) {
  Lines lines;
  for (int i = 0; i < static_cast<int>(presses.size()); ++i) {
    const PivotPress& press = presses[static_cast<std::size_t>(i)];
    const Vector3d hand(press.hip.x, press.hip.y, press.hip.z);
    const Vector3d rod = Vector3d(press.tip.x, press.tip.y, press.tip.z) - hand;
    const double length = rod.norm();
    if (std::isfinite(length) && length > kShortestRod)
      lines.push_back({hand, rod / length, length, i});
    else
      left_out.push_back(i);
  }
  return lines;
}

Vector3d Across(const Line& line, const Vector3d& v) {
  return v - line.direction * line.direction.dot(v);
}

double Reach(const Line& line, const Vector3d& pivot) {
  return line.direction.dot(pivot - line.hand);
}

// Returns the distance of the pivot from the line, divided by the noise of the line there.
double Misfit(const Line& line, const Vector3d& pivot, const Noise& noise) {
  return Across(line, pivot - line.hand).norm() / noise.At(Reach(line, pivot));
}

double SquaredMisfit(const Lines& lines, const Vector3d& pivot, const Noise& noise) {
  double sum = 0.0;
  for (const Line& line : lines) {
    const double misfit = Misfit(line, pivot, noise);
    sum += misfit * misfit;
  }
  return sum;
}

// Gauss-Newton on e/s(r): the residual of a press when its true direction is solved for in closed
// form together with the pivot, with position weighted by s_p and angle by s_θ. Minimising e alone,
// as the linear equations do, biases the pivot towards the hands, where noisy directions miss by
// less.
void Refine(const Lines& lines, const Noise& noise, Fit& fit) {
  double cost = SquaredMisfit(lines, fit.pivot, noise);
  for (int iteration = 0; iteration < 30; ++iteration) {
    Matrix3d normal = Matrix3d::Zero();
    Vector3d gradient = Vector3d::Zero();
    for (const Line& line : lines) {
      const Vector3d e = Across(line, fit.pivot - line.hand);
      const double reach = Reach(line, fit.pivot), s = noise.At(reach);
      const Matrix3d across = Matrix3d::Identity() - line.direction * line.direction.transpose();
      const Matrix3d slope = across / s - e * line.direction.transpose() *
                                              (reach * noise.angle * noise.angle / (s * s * s));
      normal += slope.transpose() * slope;
      gradient += slope.transpose() * e / s;
    }
    const Vector3d step = -normal.ldlt().solve(gradient);
    if (!step.allFinite()) return;
    // Halves a step that does not lower the cost; noise may distort it far from the solution.
    double share = 1.0;
    while (share > 1e-3 && !(SquaredMisfit(lines, fit.pivot + share * step, noise) <= cost))
      share /= 2.0;
    if (share <= 1e-3) return;
    fit.pivot += share * step;
    cost = SquaredMisfit(lines, fit.pivot, noise);
    if (step.norm() < 1e-12) return;
  }
}

Fit FitPivot(const Lines& lines, const Noise& noise) {
  Matrix3d a = Matrix3d::Zero();
  Vector3d b = Vector3d::Zero();
  for (const Line& line : lines) {
    a += Matrix3d::Identity() - line.direction * line.direction.transpose();
    b += Across(line, line.hand);
  }
  Fit fit;
  const Eigen::LDLT<Matrix3d> solver(a);
  fit.pivot = solver.solve(b);
  if (!fit.pivot.allFinite()) return fit;
  if (noise.angle > 0.0) Refine(lines, noise, fit);
  for (const Line& line : lines) {
    const double s = noise.At(Reach(line, fit.pivot));
    fit.information +=
        (Matrix3d::Identity() - line.direction * line.direction.transpose()) / (s * s);
  }
  fit.solved = true;
  return fit;
}

// Ratio of the misses of the lines to those that the noise explains.
double ScaleOf(const Lines& lines, const Vector3d& pivot, const Noise& noise) {
  const double freedom = 2.0 * static_cast<double>(lines.size()) - 3.0;
  return std::sqrt(SquaredMisfit(lines, pivot, noise) / freedom);
}

Lines LinesWithin(const Lines& lines, const Vector3d& pivot, const Noise& noise, double limit) {
  Lines within;
  for (const Line& line : lines)
    if (Misfit(line, pivot, noise) <= limit) within.push_back(line);
  return within;
}

// Finds the lines that agree on one point. It starts from the pair of lines whose common point has
// the smallest median misfit, then alternates fitting and selection. Where the lines are noisier
// than stated, the scale is taken from them, so that noise does not count as outliers.
Lines AgreeingLines(const Lines& lines, const Noise& noise, const PivotOptions& options) {
  const int n = static_cast<int>(lines.size());
  // A few thousand lines are enough to judge a pair.
  Lines judges;
  const std::size_t stride = 1 + lines.size() / kManyLines;
  for (std::size_t k = 0; k < lines.size(); k += stride) judges.push_back(lines[k]);
  std::vector<double> misfits(judges.size());
  Vector3d best = Vector3d::Zero();
  double best_median = INFINITY;
  const auto try_pair = [&](int i, int j) {
    const Lines pair = {lines[static_cast<std::size_t>(i)], lines[static_cast<std::size_t>(j)]};
    if (pair[0].direction.cross(pair[1].direction).norm() < 1e-3) return;
    const Fit fit = FitPivot(pair, {noise.position, 0.0});
    if (!fit.solved) return;
    for (std::size_t k = 0; k < judges.size(); ++k)
      misfits[k] = Misfit(judges[k], fit.pivot, noise);
    const auto middle = misfits.begin() + static_cast<std::ptrdiff_t>(misfits.size() / 2);
    std::nth_element(misfits.begin(), middle, misfits.end());
    if (*middle < best_median) {
      best_median = *middle;
      best = fit.pivot;
    }
  };
  if (static_cast<long>(n) * (n - 1) / 2 <= options.max_trials) {
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j) try_pair(i, j);
  } else {
    // Avoids std::uniform_int_distribution, whose numbers differ between libraries.
    std::mt19937 random(static_cast<std::uint32_t>(options.seed));
    for (int trial = 0; trial < options.max_trials; ++trial) {
      const int i = static_cast<int>(random() % static_cast<unsigned>(n));
      const int j = static_cast<int>(random() % static_cast<unsigned>(n));
      if (i != j) try_pair(i, j);
    }
  }
  if (!std::isfinite(best_median)) return lines;

  // The median length of a two-dimensional Gaussian is 1.177 sigma; small samples underestimate it.
  const double scale = best_median / 1.1774 * (1.0 + 5.0 / (n - 2));
  Lines agreeing = LinesWithin(lines, best, noise, kOutlier * std::max(1.0, scale));
  for (int round = 0; round < 10 && agreeing.size() >= 3; ++round) {
    const Fit fit = FitPivot(agreeing, noise);
    if (!fit.solved) break;
    const double limit = kOutlier * std::max(1.0, ScaleOf(agreeing, fit.pivot, noise));
    Lines next = LinesWithin(lines, fit.pivot, noise, limit);
    const bool settled =
        next.size() == agreeing.size() &&
        std::equal(next.begin(), next.end(), agreeing.begin(),
                   [](const Line& a, const Line& b) { return a.press == b.press; });
    agreeing = std::move(next);
    if (settled) break;
  }
  return agreeing;
}

// Attributes misses that the stated noise does not explain to the angles of the handle. With
// unstated noise of 2 degrees, 32 presses within 20 degrees and 100 mm of reach, this lowers the
// error from 7.7 to 3.7 mm, as predicted; with correctly stated noise it changes nothing.
Noise NoiseOf(const Lines& lines, const Vector3d& pivot, const Noise& stated, double scale) {
  double sum = 0.0;
  for (const Line& line : lines) sum += Reach(line, pivot) * Reach(line, pivot);
  const double reach = std::max(std::sqrt(sum / static_cast<double>(lines.size())), 1e-3);
  const double unexplained = stated.At(reach) * std::sqrt(scale * scale - 1.0);
  return {stated.position, std::hypot(stated.angle, unexplained / reach)};
}

// Finds the line furthest from line `i` in direction, and the cosine of the angle between the two.
std::pair<std::size_t, double> FurthestFrom(const Lines& lines, std::size_t i) {
  std::pair<std::size_t, double> furthest{i, 1.0};
  for (std::size_t j = 0; j < lines.size(); ++j) {
    const double cosine = std::abs(lines[i].direction.dot(lines[j].direction));
    if (cosine < furthest.second) furthest = {j, cosine};
  }
  return furthest;
}

// Returns the largest angle between two undirected lines, 0 to π/2. Among the thousands of presses
// of a swing, going from one furthest line to the next finds it without trying all pairs.
double SpreadOf(const Lines& lines) {
  double least = 1.0;
  if (lines.size() <= kManyLines) {
    for (std::size_t i = 0; i < lines.size(); ++i)
      least = std::min(least, FurthestFrom(lines, i).second);
  } else {
    std::size_t line = 0;
    for (int sweep = 0; sweep < 8; ++sweep) {
      const auto [next, cosine] = FurthestFrom(lines, line);
      least = std::min(least, cosine);
      line = next;
    }
  }
  return std::acos(std::clamp(least, 0.0, 1.0));
}

// Returns the mean squared sine of the angle between the lines and their common direction, as a
// sample variance.
double ScatterOf(const Lines& lines) {
  Matrix3d sum = Matrix3d::Zero();
  for (const Line& line : lines) sum += line.direction * line.direction.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(sum, Eigen::EigenvaluesOnly);
  const double n = static_cast<double>(lines.size());
  return std::max(0.0, n - solver.eigenvalues()[2]) / (n - 1.0);
}

// Returns the noise at the pivot from the noise of both ends: at an end it is that of the end,
// beyond it more.
double EndNoiseFactor(const Lines& lines, const Vector3d& pivot) {
  double factor = 1.0;
  for (const Line& line : lines) {
    const double along = Reach(line, pivot) / line.length;
    factor = std::max(factor, std::hypot(1.0 - along, along));
  }
  return factor;
}

double SigmaOf(const Matrix3d& information) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(information, Eigen::EigenvaluesOnly);
  const Vector3d& values = solver.eigenvalues();
  if (!(values[0] > 1e-12 * values[2])) return INFINITY;
  return std::sqrt(values.cwiseInverse().sum());
}

double ConditionOf(const Lines& lines) {
  Matrix3d a = Matrix3d::Zero();
  for (const Line& line : lines)
    a += Matrix3d::Identity() - line.direction * line.direction.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(a, Eigen::EigenvaluesOnly);
  const Vector3d& values = solver.eigenvalues();
  return values[0] > 1e-15 * values[2] ? values[2] / values[0] : INFINITY;
}

std::string InMm(double metres) {
  return std::isfinite(metres) ? fmt::format("{:.3g} mm", MmFromMetres(metres))
                               : std::string("nothing");
}

// Advice for presses of a button, or for a swing.
struct Wording {
  const char *one, *many, *start, *wider, *while_moved, *again, *longer;
};
constexpr Wording kPressWords{
    "press",
    "presses",
    "press at least twice, with the rod in different directions",
    "swing the rod by {:.0f} degrees or more between presses",
    "between presses",
    "press again",
    "swing wider or press more often",
};
constexpr Wording kSwingWords{
    "pose",
    "poses",
    "keep swinging the rod through the incision, in different directions",
    "swing the rod wider, by {:.0f} degrees or more",
    "while the rod was swung",
    "begin again",
    "swing wider or longer",
};

std::string WiderWords(const Wording& words, double angle) {
  return fmt::format(fmt::runtime(words.wider), std::max(30.0, DegreesFromRadians(angle)));
}

// Finds the presses whose pivot lies outside the segment from hand to tip by more than `margin`.
std::string OutsideReason(const Lines& lines, const Vector3d& pivot, double margin,
                          const Wording& words) {
  int outside = 0;
  double furthest = 0.0;  // negative: behind the hand
  for (const Line& line : lines) {
    const double reach = Reach(line, pivot);
    const double beyond = reach < 0.0 ? reach : std::max(0.0, reach - line.length);
    if (std::abs(beyond) <= margin) continue;
    ++outside;
    if (std::abs(beyond) > std::abs(furthest)) furthest = beyond;
  }
  if (outside == 0) return {};
  return fmt::format(
      "in {} of {} {} the rods meet outside the rod, up to {} {}; the incision must lie "
      "between "
      "hand and tip, so check the rod's length and put the tip through the incision",
      outside, lines.size(), words.many, InMm(std::abs(furthest)),
      furthest < 0.0 ? "behind the hand" : "beyond the tip");
}

}  // namespace

const char* ToString(PivotStatus status) {
  switch (status) {
    case PivotStatus::kOk:
      return "ok";
    case PivotStatus::kTooFew:
      return "too_few";
    case PivotStatus::kTooNarrow:
      return "too_narrow";
    case PivotStatus::kInconsistent:
      return "inconsistent";
    case PivotStatus::kOutsideRod:
      return "outside_rod";
  }
  return "";
}

PivotCalibration CalibratePivot(std::span<const PivotPress> presses, const PivotOptions& options,
                                PivotSource source) {
  const Wording& words = source == PivotSource::kSwing ? kSwingWords : kPressWords;
  PivotCalibration result;
  const Noise noise{options.position_noise, options.angle_noise};
  const Lines lines = UsableLines(presses, result.left_out);
  result.poses_used = static_cast<int>(lines.size());
  if (lines.size() < 2) {
    result.reason = fmt::format("{} usable {}; {}", lines.size(),
                                lines.size() == 1 ? words.one : words.many, words.start);
    return result;
  }

  // Selects the presses that agree, and their point.
  const Lines used =
      lines.size() < kFewestForOutliers ? lines : AgreeingLines(lines, noise, options);
  const bool agree =
      used.size() >= 2 && static_cast<double>(used.size()) >=
                              options.min_agreement * static_cast<double>(lines.size()) - 1e-9;
  const Lines& chosen = agree ? used : lines;
  for (std::size_t k = 0, next = 0; k < lines.size(); ++k) {  // both are in press order
    if (next < chosen.size() && chosen[next].press == lines[k].press)
      ++next;
    else
      result.left_out.push_back(lines[k].press);
  }
  std::sort(result.left_out.begin(), result.left_out.end());
  result.poses_used = static_cast<int>(chosen.size());
  result.spread = SpreadOf(chosen);
  result.condition = ConditionOf(chosen);
  Fit fit = FitPivot(chosen, noise);

  // Predicts the error from the stated noise, or from the residual where that is larger.
  double expected = INFINITY, scale = 0.0;
  result.sigma = INFINITY;
  if (fit.solved) {
    expected = SigmaOf(fit.information) * EndNoiseFactor(chosen, fit.pivot);
    scale = ScaleOf(chosen, fit.pivot, noise);
    result.sigma = expected * std::max(1.0, scale);
    if (scale > 1.0 && chosen.size() >= kFewestForOutliers) {
      const Noise larger = NoiseOf(chosen, fit.pivot, noise, scale);
      fit = FitPivot(chosen, larger);
      result.sigma = SigmaOf(fit.information) * EndNoiseFactor(chosen, fit.pivot) *
                     std::max(1.0, ScaleOf(chosen, fit.pivot, larger));
    }
    double sum = 0.0;
    for (const Line& line : chosen) sum += Across(line, fit.pivot - line.hand).squaredNorm();
    result.residual = std::sqrt(sum / static_cast<double>(chosen.size()));
  }

  const double spread_deg = DegreesFromRadians(result.spread);
  if (result.spread < options.min_spread || !(expected <= options.max_sigma)) {
    result.status = PivotStatus::kTooNarrow;
    result.reason = fmt::format(
        "the rods are at most {:.2g} degrees apart in direction (opposite ones count as the same), "
        "which leaves the pivot known to {} only (limit {}); {}",
        spread_deg, InMm(result.sigma), InMm(options.max_sigma),
        WiderWords(words, options.min_spread));
    return result;
  }
  if (ScatterOf(chosen) < kLeastScatter * 2.0 * noise.angle * noise.angle) {
    result.status = PivotStatus::kTooNarrow;
    result.reason = fmt::format(
        "the rods are at most {:.2g} degrees apart in direction, which is little more than the "
        "handle's angles tremble by ({:.2g} degrees rms); {}",
        spread_deg, DegreesFromRadians(noise.angle), WiderWords(words, 20.0 * noise.angle));
    return result;
  }
  result.pivot = glm::dvec3(fit.pivot.x(), fit.pivot.y(), fit.pivot.z());
  if (!agree) {
    result.status = PivotStatus::kInconsistent;
    result.reason =
        fmt::format("only {} of {} {} agree on one point; the incision moved {}: {}", used.size(),
                    lines.size(), words.many, words.while_moved, words.again);
  } else if (scale > options.residual_limit) {
    result.status = PivotStatus::kInconsistent;
    result.reason = fmt::format(
        "the rods miss one point by {} rms, {:.2g} times what the stated noise explains; either "
        "the "
        "incision moved {}, or the handle's angles are noisier than stated (option "
        "angle_noise)",
        InMm(result.residual), scale, words.while_moved);
  } else if (!(result.sigma <= options.max_sigma)) {
    result.status = PivotStatus::kInconsistent;
    result.reason = fmt::format(
        "the rods miss one point by {} rms, which leaves the pivot known to {} only (limit {}); "
        "{}",
        InMm(result.residual), InMm(result.sigma), InMm(options.max_sigma), words.longer);
  } else {
    const double margin = 3.0 * std::hypot(result.sigma, noise.position);
    result.reason = OutsideReason(chosen, fit.pivot, margin, words);
    result.status = result.reason.empty() ? PivotStatus::kOk : PivotStatus::kOutsideRod;
  }
  if (result.status == PivotStatus::kOk && !result.left_out.empty())
    result.reason = fmt::format("{} of {} {} disagree with the others and were left out",
                                result.left_out.size(), presses.size(), words.many);
  return result;
}

}  // namespace arthro::simulation
