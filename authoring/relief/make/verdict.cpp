#include "authoring/relief/make/verdict.h"

#include <algorithm>

#include <fmt/format.h>

#include "authoring/relief/median.h"

namespace arthro::authoring {

ReliefVerdict JudgeMotion(const Motion& motion) {
  constexpr double kStill = 0.5;         // px that the median track moves
  constexpr double kRotation = 1.0;      // px that the best rotation leaves
  constexpr int kVerified = 40;          // tracks that a frame should keep
  constexpr double kTexture = 0.3;       // share of the frames that keep as many
  constexpr double kMoves = 1.5;         // px of residual that neighbours share
  constexpr double kLargestPiece = 0.5;  // share of the usable frames
  constexpr double kSamePath = 0.1;      // share of the path's spread
  const double frames = std::max(1.0, static_cast<double>(motion.frames.size()));
  const auto share = [&](auto&& is_true) {
    const auto count = std::count_if(motion.frames.begin(), motion.frames.end(), is_true);
    return static_cast<double>(count) / frames;
  };
  const double tracked = share([](const MotionFrame& f) { return f.tracks >= kVerified; });
  if (tracked < kTexture)
    return {"texture",
            fmt::format("only {:.0f} % of the frames keep {} points that can be followed; take "
                        "footage that moves slowly over tissue with some texture",
                        100 * tracked, kVerified),
            "share of frames with enough tracks", tracked, kTexture};
  if (motion.median_reach_px < kStill)
    return {"still", "the picture does not move, so that it shows no depth; move the tip",
            "median motion of a track, px", motion.median_reach_px, kStill};
  if (motion.rotation_residual_px < kRotation)
    return {"rotation_only",
            "the camera only turned, so that near and far moved alike; tilt the scope about the "
            "portal or advance it",
            "median residual after a rotation, px", motion.rotation_residual_px, kRotation};
  const double verified =
      share([](const MotionFrame& f) { return f.reason.empty() && f.inliers >= kVerified; });
  const double posed = share([](const MotionFrame& f) { return f.reason.empty(); });
  if (posed < kLargestPiece)
    return {"pieces",
            fmt::format("only {:.0f} % of the frames join into one reconstruction; take footage "
                        "that moves more slowly, or a shorter part of it",
                        100 * posed),
            "share of frames with a pose", posed, kLargestPiece};
  if (verified < kTexture)
    return {"texture",
            fmt::format("only {:.0f} % of the frames keep {} points that agree with their poses; "
                        "take footage that moves slowly over tissue with some texture",
                        100 * verified, kVerified),
            "share of frames with enough verified tracks", verified, kTexture};
  if (motion.coherent_residual_px > kMoves)
    return {"tissue_moves",
            "points that are seen for long do not stay in place; take footage in which the tissue "
            "is at rest and no instrument touches it",
            "residual that neighbouring tracks share, px", motion.coherent_residual_px, kMoves};
  if (motion.start_difference > kSamePath)
    return {"ambiguous",
            "several ways of the scope explain the clip equally well; take footage that moves more "
            "slowly, with more texture or fewer highlights",
            "difference between the paths from different starts over their spread",
            motion.start_difference, kSamePath};
  return {};
}

ReliefVerdict JudgePivot(double miss, double spread) {
  constexpr double kMostMiss = 0.1, kWide = 0.0873;  // rad (5°)
  if (spread < kWide || miss <= kMostMiss) return {};
  return {"pivot",
          "the shafts do not meet in one point, so that the poses are doubtful; check the view "
          "angle and the lens, or hold the camera head still",
          "distance between shafts and portal over the insertion", miss, kMostMiss};
}

ReliefVerdict JudgeCoverage(double coverage) {
  constexpr double kLeast = 0.2;
  if (coverage >= kLeast) return {};
  return {"dense",
          fmt::format("only {:.0f} % of the tissue in view was measured with confidence; take "
                      "footage with more light, or that comes nearer",
                      100 * coverage),
          "share of the cells measured with confidence", coverage, kLeast};
}

ReliefVerdict JudgeTool(const ReliefVerdict& found, std::span<const double> shares) {
  constexpr double kHides = 0.2;  // share of the window, at the median
  const bool lacks_tissue = found.kind == "texture" || found.kind == "pieces" ||
                            found.kind == "ambiguous" || found.kind == "dense";
  const double hidden = Median({shares.begin(), shares.end()});
  if (!lacks_tissue || hidden < kHides) return found;
  return {"tool",
          fmt::format("an instrument hides {:.0f} % of the picture in most frames; withdraw it, or "
                      "give a part of the clip without it",
                      100 * hidden),
          "share of the picture that an instrument hides, median", hidden, kHides};
}

}  // namespace arthro::authoring
