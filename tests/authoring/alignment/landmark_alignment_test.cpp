// Poses from landmarks, on small inputs made in code.
#include "authoring/alignment/landmark_alignment.h"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "tests/support/shapes.h"

namespace arthro::authoring {
namespace {

const SurfaceMesh& Block() {
  static const SurfaceMesh kBlock =
      test::Box(glm::dvec3(-10, -6, -2) * kMm, glm::dvec3(10, 6, 2) * kMm);
  return kBlock;
}

Pose Truth(double scale = 1) {
  return {glm::dvec3(3, -2, 30) * kMm,
          glm::angleAxis(2.1, glm::normalize(glm::dvec3(0.3, -1, 0.5))), scale};
}

// Exact pairs at corners of the block.
std::vector<LandmarkPair> Pairs(const Pose& truth, std::initializer_list<int> corners) {
  std::vector<LandmarkPair> pairs;
  for (const int corner : corners) {
    LandmarkPair& pair = pairs.emplace_back();
    pair.name = "corner " + std::to_string(corner);
    pair.x_in_tissue = Block().vertices[static_cast<std::size_t>(corner)];
    pair.scene.x_in_portal = truth * pair.x_in_tissue;
    pair.scene.px_per_radian = 334;  // 512 px over 90 degrees, equisolid
    pair.scene.lateral_sigma = pair.scene.range_sigma = 0.2 * kMm;
  }
  return pairs;
}

double Angle(const glm::dquat& a, const glm::dquat& b) {
  return 2 * std::acos(std::min(1.0, std::abs(glm::dot(a, b))));
}

bool Warns(const LandmarkAlignment& alignment, const std::string& words) {
  for (const std::string& warning : alignment.warnings)
    if (warning.find(words) != std::string::npos) return true;
  return false;
}

TEST(LandmarkAlignment, RecoversAnExactPose) {
  const LandmarkAlignment found = AlignLandmarks(Pairs(Truth(), {0, 3, 5, 6}), {}, Block());
  ASSERT_TRUE(found.is_aligned()) << found.sentence;
  // Rounding of a fit whose residuals are zero.
  EXPECT_LT(glm::distance(found.portal_from_tissue.position, Truth().position), 1e-9);
  EXPECT_LT(Angle(found.portal_from_tissue.quaternion, Truth().quaternion), 1e-6);
  EXPECT_EQ(found.portal_from_tissue.scale, 1.0);
  EXPECT_LT(found.rms, 1e-9);
  EXPECT_GT(found.position_sigma, 0);
  EXPECT_TRUE(found.warnings.empty()) << found.warnings.front();
}

TEST(LandmarkAlignment, SolvesForTheScaleWhenAsked) {
  LandmarkOptions options;
  options.scale = AlignScale::kSolve;
  const auto pairs = Pairs(Truth(1.3), {0, 3, 5, 6});
  const LandmarkAlignment found = AlignLandmarks(pairs, {}, Block(), options);
  ASSERT_TRUE(found.is_aligned()) << found.sentence;
  EXPECT_NEAR(found.portal_from_tissue.scale, 1.3, 1e-7);
  EXPECT_GT(found.scale_sigma, 0);
  Pose present;
  present.scale = 1.3;
  EXPECT_LT(AlignLandmarks(pairs, present, Block()).rms, 1e-8) << "a scale that is kept is used";
}

TEST(LandmarkAlignment, NamesTheWrongPairAndLeavesItOut) {
  auto pairs = Pairs(Truth(), {0, 1, 2, 3, 4, 5, 6, 7});
  pairs[2].scene.x_in_portal += glm::dvec3(0, 6, 2) * kMm;
  const LandmarkAlignment found = AlignLandmarks(pairs, {}, Block());
  ASSERT_TRUE(found.is_aligned()) << found.sentence;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(found.residuals[i].is_wrong, i == 2) << i;
    EXPECT_EQ(found.residuals[i].is_used, i != 2) << i;
  }
  EXPECT_NEAR(found.residuals[2].distance, std::sqrt(40.0) * kMm, 1e-6);
  EXPECT_TRUE(Warns(found, "Pair 3 (corner 2) is 6.3 mm away")) << found.warnings.front();
  EXPECT_LT(glm::distance(found.portal_from_tissue.position, Truth().position), 1e-7);
}

TEST(LandmarkAlignment, LeavesOutWhatItsAuthorLeavesOut) {
  auto pairs = Pairs(Truth(), {0, 3, 5, 6});
  pairs[1].is_left_out = true;
  pairs[1].scene.x_in_portal += glm::dvec3(5 * kMm);
  const LandmarkAlignment found = AlignLandmarks(pairs, {}, Block());
  ASSERT_TRUE(found.is_aligned());
  EXPECT_FALSE(found.residuals[1].is_used);
  EXPECT_FALSE(found.residuals[1].is_wrong);
  EXPECT_LT(found.rms, 1e-8);
  EXPECT_TRUE(Warns(found, "Nothing checks three pairs"));
}

TEST(LandmarkAlignment, RefusesWhatDoesNotDetermineAPose) {
  EXPECT_EQ(AlignLandmarks(Pairs(Truth(), {0, 3}), {}, Block()).verdict, AlignVerdict::kTooFew);
  auto line = Pairs(Truth(), {0, 1, 0, 1});
  line[2].x_in_tissue = glm::dvec3(0, -6, -2) * kMm;
  line[2].scene.x_in_portal = Truth() * line[2].x_in_tissue;
  const LandmarkAlignment found = AlignLandmarks(line, {}, Block());
  EXPECT_EQ(found.verdict, AlignVerdict::kCollinear);
  EXPECT_EQ(found.portal_from_tissue, Pose{}) << "the pose stays as it was";
  auto random = Pairs(Truth(), {0, 3, 5, 6});
  random[0].scene.x_in_portal = glm::dvec3(10, 0, 20) * kMm;
  random[2].scene.x_in_portal = glm::dvec3(-10, 9, 44) * kMm;
  const LandmarkAlignment rigid = AlignLandmarks(random, {}, Block());
  EXPECT_EQ(rigid.verdict, AlignVerdict::kInconsistent);
  EXPECT_NE(rigid.sentence.find("solve for the scale"), std::string::npos);
  double largest = 0;
  std::string words;
  for (std::size_t i = 0; i < random.size(); ++i)
    for (std::size_t j = i + 1; j < random.size(); ++j) {
      const double model = glm::distance(random[i].x_in_tissue, random[j].x_in_tissue);
      const double place = glm::distance(random[i].scene.x_in_portal, random[j].scene.x_in_portal);
      if (std::abs(place - model) <= largest) continue;
      largest = std::abs(place - model);
      words = fmt::format("landmarks {} and {} are {:.1f} mm apart on the model, but {:.1f} mm",
                          i + 1, j + 1, 1e3 * model, 1e3 * place);
    }
  EXPECT_TRUE(Warns(rigid, words)) << words;
  LandmarkOptions scaled;
  scaled.scale = AlignScale::kSolve;
  const LandmarkAlignment free = AlignLandmarks(random, {}, Block(), scaled);
  EXPECT_EQ(free.verdict, AlignVerdict::kInconsistent);
  EXPECT_EQ(free.sentence.find("solve for the scale"), std::string::npos) << "it is solved for";
}

// Said of the landmarks before, which lie well apart on the model.
TEST(LandmarkAlignment, PlacesOnOneLineOrPointOfTheSceneAreNotALineOfTheModel) {
  for (const double apart : {0.0, 0.002}) {
    auto pairs = Pairs(Truth(), {0, 1, 2, 3});
    for (std::size_t i = 0; i < pairs.size(); ++i)
      pairs[i].scene.x_in_portal = glm::dvec3(static_cast<double>(i) * apart, 0, 0.03);
    const LandmarkAlignment found = AlignLandmarks(pairs, {}, Block());
    EXPECT_EQ(found.verdict, AlignVerdict::kCollinear);
    EXPECT_TRUE(found.sentence.starts_with("The places of the landmarks in the scene lie"))
        << found.sentence;
  }
}

TEST(LandmarkAlignment, WarnsOfLandmarksNearlyOnALine) {
  auto pairs = Pairs(Truth(), {0, 1, 0, 1});
  pairs[2].x_in_tissue = glm::dvec3(0, -4.5, -2) * kMm;
  pairs[3].x_in_tissue = glm::dvec3(5, -6, -1) * kMm;
  for (LandmarkPair& pair : pairs) pair.scene.x_in_portal = Truth() * pair.x_in_tissue;
  const LandmarkAlignment found = AlignLandmarks(pairs, {}, Block());
  ASSERT_TRUE(found.is_aligned()) << found.sentence;
  EXPECT_TRUE(Warns(found, "nearly on one line"));
  // The error about the line is much larger than that across it.
  EXPECT_GT(found.worst_rotation_sigma, 0.9 * found.rotation_sigma);
}

TEST(LandmarkAlignment, WarnsOfLandmarksInACluster) {
  auto pairs = Pairs(Truth(), {0, 0, 0, 0});
  pairs[1].x_in_tissue.x += 3 * kMm;
  pairs[2].x_in_tissue.y += 3 * kMm;
  pairs[3].x_in_tissue.z += 3 * kMm;
  for (LandmarkPair& pair : pairs) pair.scene.x_in_portal = Truth() * pair.x_in_tissue;
  EXPECT_TRUE(Warns(AlignLandmarks(pairs, {}, Block()),
                    "The landmarks are within 4.2 mm of a model of 23.7 mm"));
}

TEST(LandmarkAlignment, WarnsOfGuessedRanges) {
  auto pairs = Pairs(Truth(), {0, 3, 5, 6});
  pairs[1].scene.is_guessed = pairs[3].scene.is_guessed = true;
  EXPECT_TRUE(
      Warns(AlignLandmarks(pairs, {}, Block()), "The range of 2 of 4 landmarks was guessed"));
}

TEST(LandmarkAlignment, StatesTheResidualInThePictureThatWasClicked) {
  auto pairs = Pairs(Truth(), {0, 1, 2, 3, 4, 5, 6, 7});
  pairs[4].scene.px_per_radian = 0;
  const glm::dvec3 line = glm::normalize(pairs[0].scene.x_in_portal);
  pairs[0].scene.x_in_portal += 8 * kMm * glm::normalize(glm::cross(line, glm::dvec3(1, 0, 0)));
  const LandmarkAlignment found = AlignLandmarks(pairs, {}, Block());
  ASSERT_TRUE(found.is_aligned());
  ASSERT_TRUE(found.residuals[0].px);
  const double range = glm::length(Truth() * pairs[0].x_in_tissue);
  EXPECT_NEAR(*found.residuals[0].px, 334 * std::atan(8 * kMm / range), 1e-3);
  EXPECT_FALSE(found.residuals[4].px) << "it was given by coordinates";
}

TEST(LandmarkAlignment, GivesTheSameBytesTwice) {
  auto pairs = Pairs(Truth(), {0, 1, 2, 3, 4, 5, 6, 7});
  for (std::size_t i = 0; i < pairs.size(); ++i)
    pairs[i].scene.x_in_portal.x += 1e-4 * static_cast<double>(i * i % 5);
  EXPECT_EQ(AlignLandmarks(pairs, {}, Block()).portal_from_tissue,
            AlignLandmarks(pairs, {}, Block()).portal_from_tissue);
}

}  // namespace
}  // namespace arthro::authoring
