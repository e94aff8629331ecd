#include "authoring/relief/motion/motion.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include "authoring/relief/median.h"
#include "authoring/relief/motion/frame_inliers.h"
#include "authoring/relief/motion/growth.h"
#include "authoring/relief/motion/join_pieces.h"
#include "authoring/relief/motion/pair_model.h"
#include "simulation/core/at.h"

namespace arthro::authoring {
namespace {

constexpr int kLeastShared = 40;  // tracks of a pair that a reconstruction starts from
constexpr int kStarts = 8;        // pairs that are tried as a start of a piece
constexpr int kGrowths = 4;       // starts from which the largest piece is grown

struct Start {
  int a, b;
  double score;
};

int Count(const std::vector<bool>& flags) {
  return static_cast<int>(std::count(flags.begin(), flags.end(), true));
}

// Pairs of frames by how much depth they show, best first; fills the quantities of the verdicts.
std::vector<Start> StartsOf(const std::vector<Track>& tracks, const TracksByFrame& by_frame,
                            const LensProfile& lens, const Progress& progress, Motion& motion) {
  std::vector<double> reaches;
  for (const Track& track : tracks) {
    double reach = 0;
    for (const Observation& seen : track.seen)
      reach = std::max(reach, (seen.pixel - track.seen.front().pixel).norm());
    if (track.seen.size() >= 3) reaches.push_back(reach);
  }
  motion.median_reach_px = Median(reaches);
  const int frames = static_cast<int>(by_frame.size());
  std::vector<Start> starts;
  std::vector<double> residuals;
  for (int a = 0; a < frames; ++a) {
    progress.Step("comparing frames", 0.1 * a / frames);
    for (int b = a + 1; b < frames; ++b) {
      const auto shared = SharedTracks(by_frame, a, b);
      if (static_cast<int>(shared.size()) < kLeastShared) continue;
      const double residual = FitRotation(tracks, shared).median * lens.focal_px();
      residuals.push_back(residual);
      constexpr double kEnough = 12;      // px of parallax, beyond which more does not help
      constexpr std::size_t kMany = 400;  // tracks
      starts.push_back(
          {a, b,
           std::min(residual, kEnough) * static_cast<double>(std::min(shared.size(), kMany))});
    }
  }
  if (!residuals.empty()) {
    const auto at = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() * 9 / 10);
    std::nth_element(residuals.begin(), at, residuals.end());
    motion.rotation_residual_px = *at;
  }
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& x, const Start& y) { return x.score > y.score; });
  return starts;
}

// How far the tips of `b` lie from those of `a` after the similarity that fits best, rms over the
// spread of those of `a`; nothing where too few frames have both.
std::optional<double> DifferenceOf(const Reconstruction& a, const Reconstruction& b) {
  constexpr Eigen::Index kLeastCommon = 8;  // frames
  Eigen::Matrix3Xd in_a(3, a.poses.size()), in_b(3, a.poses.size());
  Eigen::Index common = 0;
  for (std::size_t f = 0; f < a.poses.size(); ++f) {
    if (!a.poses[f] || !b.poses[f]) continue;
    in_a.col(common) = a.poses[f]->centre;
    in_b.col(common++) = b.poses[f]->centre;
  }
  if (common < kLeastCommon) return std::nullopt;
  in_a.conservativeResize(3, common);
  in_b.conservativeResize(3, common);
  const Eigen::Matrix4d a_from_b = Eigen::umeyama(in_b, in_a);
  const Eigen::Vector3d middle = in_a.rowwise().mean();
  const double spread = (in_a.colwise() - middle).norm();
  const Eigen::Matrix3Xd moved =
      (a_from_b.topLeftCorner<3, 3>() * in_b).colwise() + a_from_b.topRightCorner<3, 1>().eval();
  if (!(spread > 0)) return std::nullopt;
  return (moved - in_a).norm() / spread;
}

struct Piece {
  Reconstruction scene;
  double start_difference = 0;  // see Motion
};

// The largest piece that grows from a pair of free frames; it may reach a few frames further, so
// that it overlaps the pieces before.
Piece GrowPiece(const std::vector<Track>& tracks, const TracksByFrame& by_frame,
                const LensProfile& lens, const std::vector<Start>& starts,
                const std::vector<bool>& is_free, int growths, const Progress& progress,
                const MotionObserver& observer) {
  constexpr int kApart = 2, kOverlap = 3;  // frames
  const int frames = static_cast<int>(is_free.size());
  // Starts that differ by more than a frame, and of them those with most points.
  std::vector<std::pair<Start, Reconstruction>> tried;
  for (const Start& start : starts) {
    if (static_cast<int>(tried.size()) >= kStarts) break;
    if (!is_free[At(start.a)] || !is_free[At(start.b)]) continue;
    const bool is_new = std::none_of(tried.begin(), tried.end(), [&](const auto& other) {
      return std::abs(other.first.a - start.a) < kApart &&
             std::abs(other.first.b - start.b) < kApart;
    });
    if (!is_new) continue;
    const double done = 0.1 + 0.01 * static_cast<double>(tried.size());
    progress.Step("choosing a start", done);
    tried.emplace_back(start,
                       StartFrom(tracks, by_frame, lens, frames, start.a, start.b, progress, done));
  }
  std::stable_sort(tried.begin(), tried.end(), [](const auto& x, const auto& y) {
    return x.second.points.size() > y.second.points.size();
  });
  std::vector<bool> may_add = is_free;
  for (int f = 0; f < frames; ++f)
    for (int step = -kOverlap; step <= kOverlap; ++step)
      if (f + step >= 0 && f + step < frames && is_free[At(f + step)]) may_add[At(f)] = true;
  Piece best;
  best.scene.poses.resize(At(frames));
  int most = 0;
  std::vector<Reconstruction> grown;
  for (std::size_t i = 0; i < tried.size() && i < At(growths); ++i) {
    Reconstruction scene = tried[i].second;
    if (scene.points.size() < At(kLeastPoints)) break;
    Grow(tracks, by_frame, lens, may_add, progress, observer, scene);
    const int posed = PosedFrames(scene);
    if (posed > most) {
      most = posed;
      best.scene = scene;
    }
    if (most >= 0.9 * Count(is_free)) return best;
    grown.push_back(std::move(scene));
  }
  for (const Reconstruction& other : grown)
    best.start_difference =
        std::max(best.start_difference, DifferenceOf(best.scene, other).value_or(0));
  return best;
}

// Grows pieces until few frames are left, and joins those that share tissue. The first piece of the
// result is the largest. `start_difference`: that of the first piece, see Motion.
std::vector<Reconstruction> GrowPieces(std::vector<Track>& tracks, int frames,
                                       const LensProfile& lens, const std::vector<Start>& starts,
                                       const Progress& progress, const MotionObserver& observer,
                                       double& start_difference) {
  constexpr int kLeastPiece = 5, kMostPieces = 6;  // frames, pieces
  std::vector<Reconstruction> pieces;
  std::vector<bool> is_free(At(frames), true);
  TracksByFrame by_frame = IndexByFrame(tracks, frames);
  while (static_cast<int>(pieces.size()) < kMostPieces &&
         (pieces.empty() || Count(is_free) >= kLeastPiece)) {
    Piece grown = GrowPiece(tracks, by_frame, lens, starts, is_free, pieces.empty() ? kGrowths : 1,
                            progress, observer);
    Reconstruction& piece = grown.scene;
    if (pieces.empty()) start_difference = grown.start_difference;
    int added = 0;
    for (std::size_t f = 0; f < is_free.size(); ++f)
      if (is_free[f] && piece.poses[f]) is_free[f] = false, ++added;
    if (added < kLeastPiece && !pieces.empty()) break;
    pieces.push_back(std::move(piece));
    if (added < kLeastPiece) break;
    // Each join moves points, so that another may become possible.
    for (bool is_joined = true; is_joined;) {
      is_joined = false;
      for (std::size_t a = 0; a < pieces.size() && !is_joined; ++a)
        for (std::size_t b = a + 1; b < pieces.size() && !is_joined; ++b) {
          progress.Step("joining pieces", 0.8);
          if (!JoinPieces(pieces[b], lens, tracks, progress.stop, pieces[a])) continue;
          is_joined = true;
          pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(b));
          by_frame = IndexByFrame(tracks, frames);
          std::vector<bool> may_add = is_free;
          Grow(tracks, by_frame, lens, may_add, progress, observer, pieces[a]);
          for (std::size_t f = 0; f < is_free.size(); ++f)
            if (pieces[a].poses[f]) is_free[f] = false;
        }
    }
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const auto& x, const auto& y) { return PosedFrames(x) > PosedFrames(y); });
  return pieces;
}

}  // namespace

Motion SolveMotion(std::vector<Track>& tracks, int frames, const LensProfile& lens,
                   const Progress& progress, const MotionObserver& observer) {
  Motion motion;
  motion.frames.resize(At(frames));
  motion.scene.poses.resize(At(frames));
  const std::vector<Start> starts =
      StartsOf(tracks, IndexByFrame(tracks, frames), lens, progress, motion);
  std::vector<Reconstruction> pieces =
      GrowPieces(tracks, frames, lens, starts, progress, observer, motion.start_difference);
  for (std::size_t piece = 1; piece < pieces.size(); ++piece)
    for (std::size_t f = 0; f < pieces[piece].poses.size(); ++f)
      if (pieces[piece].poses[f]) motion.frames[f].other_piece = static_cast<int>(piece);
  motion.scene = std::move(pieces.front());
  motion.rms_px =
      AdjustBundle(tracks, lens, {.iterations = 5, .stop = progress.stop}, motion.scene, nullptr);
  progress.Step("adjusting all poses", 1);
  CountInliers(tracks, lens, motion);
  return motion;
}

}  // namespace arthro::authoring
