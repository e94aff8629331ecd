#include "authoring/panorama/pairs/coarse_align.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "authoring/panorama/pairs/direct_solver.h"
#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::authoring {
namespace {

constexpr int kLevel = kDirectLevels - 1;
constexpr int kPeaksATurn = 3;
// Distance below which two candidates are the same.
constexpr double kSame = 2.5;  // px of the coarsest level
constexpr int kFirstSteps = 4;
constexpr std::size_t kFinalists = 2;

struct Peak {
  cv::Matx33d b_from_a;  // level px
  double height = 0;
};

// Rotation and zoom about a point, as a map of frame a's level.
cv::Matx33d Turn(double angle, double zoom, const cv::Point2d& centre) {
  const double c = zoom * std::cos(angle), s = zoom * std::sin(angle);
  return {c, -s, centre.x - c * centre.x + s * centre.y,
          s, c,  centre.y - s * centre.x - c * centre.y,
          0, 0,  1};
}

cv::Matx33d Shift(double x, double y) { return {1, 0, x, 0, 1, y, 0, 0, 1}; }

// Largest difference of the two homographies over the corners of a frame of this size.
double FarthestApart(const cv::Matx33d& p, const cv::Matx33d& q, cv::Size2d size) {
  double farthest = 0;
  for (const double x : {0.15, 0.85})
    for (const double y : {0.15, 0.85}) {
      const cv::Point2d at(x * size.width, y * size.height);
      farthest = std::max(farthest, cv::norm(Apply(p, at) - Apply(q, at)));
    }
  return farthest;
}

// Adds the highest local maxima of a correlation that wraps around.
void AddPeaks(const cv::Mat& correlation, const cv::Matx33d& turned, std::vector<Peak>& peaks) {
  struct Spot {
    float height;
    int x, y;
  };
  std::vector<Spot> spots;
  const int w = correlation.cols, h = correlation.rows;
  for (int y = 0; y < h; ++y) {
    const float* row = correlation.ptr<float>(y);
    const float* up = correlation.ptr<float>((y + h - 1) % h);
    const float* down = correlation.ptr<float>((y + 1) % h);
    for (int x = 0; x < w; ++x) {
      const float v = row[x];
      if (spots.size() == kPeaksATurn && v <= spots.back().height) continue;
      const int l = (x + w - 1) % w, r = (x + 1) % w;
      if (v < row[l] || v < row[r] || v < up[x] || v < down[x] || v < up[l] || v < up[r] ||
          v < down[l] || v < down[r])
        continue;
      if (spots.size() == kPeaksATurn) spots.pop_back();
      const auto after =
          std::find_if(spots.begin(), spots.end(), [&](const Spot& s) { return s.height < v; });
      spots.insert(after, {v, x, y});
    }
  }
  for (const Spot& spot : spots) {
    // The shift is known modulo the canvas. The shorter one is more likely; the other is tried as
    // well when both have similar length.
    const int x = spot.x > w / 2 ? spot.x - w : spot.x, y = spot.y > h / 2 ? spot.y - h : spot.y;
    const int other_x = x > 0 ? x - w : x + w, other_y = y > 0 ? y - h : y + h;
    peaks.push_back({turned * Shift(x, y), spot.height});
    if (std::abs(x) > w * 3 / 8) peaks.push_back({turned * Shift(other_x, y), spot.height});
    if (std::abs(y) > h * 3 / 8) peaks.push_back({turned * Shift(x, other_y), spot.height});
  }
}

std::vector<double> TurnsWithin(double reach, double step) {
  std::vector<double> turns{0.0};
  for (int i = 1; i * step <= reach * 1.0001; ++i) {
    turns.push_back(i * step);
    turns.push_back(-i * step);
  }
  return turns;
}

bool Improve(DirectSolver& solver, Motion motion, int steps, CoarseCandidate& candidate) {
  if (!solver.Solve(motion, steps, 0.1, candidate.b_from_a)) return false;
  const Evidence evidence = solver.Weigh(candidate.b_from_a, false);
  candidate.similarity = evidence.similarity;
  candidate.certainty = evidence.certainty;
  candidate.overlap = evidence.overlap;
  // Share of the weakest part: each of nine equal parts would have a third of the whole's
  // certainty.
  const double even = std::clamp(3 * evidence.weakest_part / (evidence.certainty + 1e-6), 0.0, 1.0);
  candidate.score = evidence.certainty * (0.5 + 0.5 * even);
  return true;
}

// Sorts by score and keeps only the best among equal candidates. `size` of the frames in rectified
// px.
void SortAndThin(cv::Size2d size, std::vector<CoarseCandidate>& found) {
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& p, const auto& q) { return p.score > q.score; });
  std::vector<CoarseCandidate> kept;
  for (const CoarseCandidate& candidate : found)
    if (std::none_of(kept.begin(), kept.end(), [&](const CoarseCandidate& other) {
          return FarthestApart(candidate.b_from_a, other.b_from_a, size) < kSame * 8;
        }))
      kept.push_back(candidate);
  found = std::move(kept);
}

}  // namespace

std::vector<CoarseCandidate> CoarseCandidates(const DirectPyramid& a, const DirectPyramid& b,
                                              const cv::Matx33d* predicted,
                                              const DirectOptions& options) {
  std::vector<CoarseCandidate> found;
  if (!a.HasTexture() || !b.HasTexture()) return found;
  const DirectLevel &la = a.level(kLevel), &lb = b.level(kLevel);
  const cv::Matx33d start =
      predicted ? lb.level_from_rectified * *predicted * la.level_from_rectified.inv()
                : cv::Matx33d::eye();
  const cv::Size size = la.size(), canvas = SpectrumSize(size);
  const cv::Point2d centre(0.5 * (size.width - 1), 0.5 * (size.height - 1));
  cv::Mat soft[kTextures];
  for (const Texture texture : {kColour, kRelief})
    soft[texture] = ApodisedBand(lb.bands[texture], lb.size());

  std::vector<Peak> peaks;
  std::vector<double> zooms{1.0};
  if (options.zoom_reach > 0) zooms = {1.0, 1 + options.zoom_reach, 1 / (1 + options.zoom_reach)};
  const double reach = predicted ? options.predicted_rotation_reach : options.rotation_reach;
  cv::Mat turned_b, spectrum, correlation;
  for (const double zoom : zooms)
    for (const double angle : TurnsWithin(reach, options.rotation_step)) {
      const cv::Matx33d turned = start * Turn(angle, zoom, centre);
      for (const Texture texture : {kColour, kRelief}) {
        cv::warpPerspective(soft[texture], turned_b, turned, canvas,
                            cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT);
        cv::dft(turned_b, spectrum);
        cv::mulSpectrums(spectrum, a.spectrum(texture), spectrum, 0, true);
        cv::dft(spectrum, correlation, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
        AddPeaks(correlation, turned, peaks);
      }
    }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& p, const Peak& q) { return p.height > q.height; });
  std::vector<Peak> distinct;
  for (const Peak& peak : peaks) {
    if (static_cast<int>(distinct.size()) >= options.candidates) break;
    if (std::none_of(distinct.begin(), distinct.end(), [&](const Peak& other) {
          return FarthestApart(peak.b_from_a, other.b_from_a, size) < 2 * kSame;
        }))
      distinct.push_back(peak);
  }

  const double zoom_out = 1 / la.level_from_rectified(0, 0);
  const cv::Size2d whole(size.width * zoom_out, size.height * zoom_out);
  // A few steps for each show the promising ones; only these are refined further.
  DirectSolver solver(la, lb);
  for (const Peak& peak : distinct) {
    CoarseCandidate candidate;
    candidate.b_from_a = lb.level_from_rectified.inv() * peak.b_from_a * la.level_from_rectified;
    if (Improve(solver, Motion::kSimilarity, kFirstSteps, candidate)) found.push_back(candidate);
  }
  SortAndThin(whole, found);
  if (found.size() > kFinalists) found.resize(kFinalists);
  for (CoarseCandidate& candidate : found) {
    CoarseCandidate better = candidate;
    if (Improve(solver, Motion::kAffine, options.most_iterations, better) &&
        Improve(solver, Motion::kHomography, options.most_iterations, better) &&
        better.score > candidate.score)
      candidate = better;
  }
  SortAndThin(whole, found);
  return found;
}

std::optional<cv::Matx33d> CoarseAlign(const DirectPyramid& a, const DirectPyramid& b,
                                       const cv::Matx33d* predicted, const DirectOptions& options) {
  const std::vector<CoarseCandidate> found = CoarseCandidates(a, b, predicted, options);
  if (found.empty()) return std::nullopt;
  return found.front().b_from_a;
}

}  // namespace arthro::authoring
