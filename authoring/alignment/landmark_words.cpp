// Sentences on the result of an alignment by landmarks.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "authoring/alignment/landmark_alignment.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

// Shares of the largest spread of the landmarks, and of the size of the model, below which the
// rotation is poorly known: 0.15 multiplies its error about the line by more than six.
constexpr double kNearlyCollinear = 0.15, kClustered = 0.25;

constexpr double kLeastContradiction = 0.5e-3;  // m, between two distances
constexpr double kOffRelief = 3e-3;             // m, of the landmarks from a relief that is a guess

std::string NameOf(std::span<const LandmarkPair> pairs, std::size_t i) {
  return pairs[i].name.empty() ? fmt::format("Pair {}", i + 1)
                               : fmt::format("Pair {} ({})", i + 1, pairs[i].name);
}

// Landmarks that differ on the model can have one place in the scene, or places on one line.
bool AreOnLineInModel(std::span<const LandmarkPair> pairs) {
  std::vector<glm::dvec3> model;
  for (const LandmarkPair& pair : pairs)
    if (!pair.is_left_out) model.push_back(pair.x_in_tissue);
  return IsOnLine(model);
}

std::string SentenceOf(AlignVerdict verdict, std::span<const LandmarkPair> pairs,
                       bool keeps_scale) {
  switch (verdict) {
    case AlignVerdict::kAligned:
      return "The landmarks determine the pose.";
    case AlignVerdict::kTooFew:
      return "Three pairs or more are needed; add another landmark.";
    case AlignVerdict::kCollinear:
      return AreOnLineInModel(pairs)
                 ? "The landmarks lie on one line, so the turn about it is not known; add one "
                   "beside it."
                 : "The places of the landmarks in the scene lie on one line, so the turn about it "
                   "is not known; place one of them again.";
    case AlignVerdict::kInconsistent:
      return keeps_scale
                 ? "No majority of the pairs agrees on one pose; check each pair, or solve for the "
                   "scale."
                 : "No majority of the pairs agrees on one pose, of whatever scale; check each "
                   "pair, or add more.";
  }
  return {};
}

// Perspective may put a tissue of known size before or behind a guessed relief.
std::optional<std::string> WordsOfRelief(std::span<const LandmarkPair> pairs,
                                         const LandmarkAlignment& alignment) {
  double farther = 0;  // m, mean of the pairs whose range was guessed
  int guessed = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ScenePoint& point = pairs[i].scene;
    if (!alignment.residuals[i].is_used || !point.is_guessed) continue;
    const glm::dvec3 x = alignment.portal_from_tissue * pairs[i].x_in_tissue;
    farther += glm::distance(x, point.eye) - glm::distance(point.x_in_portal, point.eye);
    ++guessed;
  }
  if (guessed == 0 || !(std::abs(farther) > kOffRelief * guessed)) return std::nullopt;
  const double mm = MmFromMetres(std::abs(farther) / guessed);
  return farther < 0 ? fmt::format(
                           "The tissue lies {:.1f} mm before the relief, whose ranges are guessed; "
                           "mend the depth there, or solve for the scale.",
                           mm)
                     : fmt::format(
                           "The tissue lies {:.1f} mm behind the relief, whose ranges are guessed; "
                           "mend the depth there, or solve for the scale.",
                           mm);
}

// The two pairs whose distance differs most between the model and the scene. Nothing where each
// distance agrees: a mirrored model.
std::optional<std::string> ContradictionOf(std::span<const LandmarkPair> pairs, double scale) {
  std::optional<std::string> words;
  double largest = kLeastContradiction;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (std::size_t j = i + 1; j < pairs.size(); ++j) {
      if (pairs[i].is_left_out || pairs[j].is_left_out) continue;
      const double model = scale * glm::distance(pairs[i].x_in_tissue, pairs[j].x_in_tissue);
      const double scene = glm::distance(pairs[i].scene.x_in_portal, pairs[j].scene.x_in_portal);
      if (!(std::abs(scene - model) > largest)) continue;
      largest = std::abs(scene - model);
      words = fmt::format(
          "The landmarks {} and {} are {:.1f} mm apart on the model, but {:.1f} mm in the scene.",
          i + 1, j + 1, MmFromMetres(model), MmFromMetres(scene));
    }
  return words;
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
                       std::optional<double> kept_scale, LandmarkAlignment& alignment) {
  alignment.sentence = SentenceOf(alignment.verdict, pairs, kept_scale.has_value());
  auto& warnings = alignment.warnings;
  if (alignment.verdict == AlignVerdict::kInconsistent && kept_scale)
    if (auto words = ContradictionOf(pairs, *kept_scale)) warnings.push_back(std::move(*words));
  if (!alignment.is_aligned()) return;
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
  if (kept_scale)
    if (auto words = WordsOfRelief(pairs, alignment)) warnings.push_back(std::move(*words));
  if (used.size() == 3)
    warnings.push_back("Nothing checks three pairs; a fourth would show a wrong one.");
}

}  // namespace arthro::authoring
