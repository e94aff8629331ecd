// Sentences on the result of an alignment by landmarks.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "authoring/alignment/landmark_alignment.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

// Shares of the largest spread of the landmarks, and of the size of the model, below which the
// rotation is poorly known: 0.15 multiplies its error about the line by more than six.
constexpr double kNearlyCollinear = 0.15, kClustered = 0.25;

std::string NameOf(std::span<const LandmarkPair> pairs, std::size_t i) {
  return pairs[i].name.empty() ? fmt::format("Pair {}", i + 1)
                               : fmt::format("Pair {} ({})", i + 1, pairs[i].name);
}

std::string SentenceOf(AlignVerdict verdict) {
  switch (verdict) {
    case AlignVerdict::kAligned:
      return "The landmarks determine the pose.";
    case AlignVerdict::kTooFew:
      return "Three pairs or more are needed; add another landmark.";
    case AlignVerdict::kCollinear:
      return "The landmarks lie on one line, so the turn about it is not known; add one beside it.";
    case AlignVerdict::kInconsistent:
      return "No majority of the pairs agrees on one pose; check each pair, or solve for the "
             "scale.";
  }
  return {};
}

}  // namespace

const char* ToString(AlignVerdict verdict) {
  switch (verdict) {
    case AlignVerdict::kAligned:
      return "aligned";
    case AlignVerdict::kTooFew:
      return "too_few";
    case AlignVerdict::kCollinear:
      return "collinear";
    case AlignVerdict::kInconsistent:
      return "inconsistent";
  }
  return "";
}

void DescribeAlignment(std::span<const LandmarkPair> pairs, double model_size,
                       LandmarkAlignment& alignment) {
  alignment.sentence = SentenceOf(alignment.verdict);
  if (!alignment.is_aligned()) return;
  auto& warnings = alignment.warnings;
  std::vector<glm::dvec3> used;
  int guessed = 0;
  double largest = 0;  // distance between two landmarks of the model
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const LandmarkResidual& residual = alignment.residuals[i];
    if (residual.is_wrong)
      warnings.push_back(fmt::format(
          "{} is {:.1f} mm away from where the others put it, so it was left out; click it again "
          "or remove it.",
          NameOf(pairs, i), MmFromMetres(residual.distance)));
    if (!residual.is_used) continue;
    for (const glm::dvec3& other : used)
      largest = std::max(largest, glm::distance(other, pairs[i].x_in_tissue));
    used.push_back(pairs[i].x_in_tissue);
    guessed += pairs[i].scene.is_guessed;
  }
  const glm::dvec3 spread = SpreadOf(used);
  if (spread.y < kNearlyCollinear * spread.x)
    warnings.push_back(fmt::format(
        "The landmarks lie nearly on one line, so the turn about it is known to ±{:.1f} "
        "degrees only; add one beside it.",
        DegreesFromRadians(alignment.worst_rotation_sigma)));
  if (largest < kClustered * model_size)
    warnings.push_back(fmt::format(
        "The landmarks are within {:.1f} mm of a model of {:.1f} mm; add some farther apart.",
        MmFromMetres(largest), MmFromMetres(model_size)));
  if (guessed > 0)
    warnings.push_back(
        fmt::format("The range of {} of {} landmarks was guessed, not measured; check the result "
                    "from a second direction.",
                    guessed, used.size()));
  if (used.size() == 3)
    warnings.push_back("Nothing checks three pairs; a fourth would show a wrong one.");
}

}  // namespace arthro::authoring
