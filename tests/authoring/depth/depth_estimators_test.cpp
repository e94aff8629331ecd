// Accuracy of the estimators on pictures with known distances, and their guarantees.
#include <cmath>
#include <cstring>
#include <ctime>
#include <limits>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "authoring/depth/depth_filter.h"
#include "authoring/depth/depth_preview.h"
#include "authoring/depth/noise/depth_noise.h"
#include "authoring/depth/noise/guided_smoothing.h"
#include "simulation/core/error.h"
#include "tests/support/depth_score.h"
#include "tests/support/knee_picture.h"
#include "tests/support/preview_error.h"

namespace arthro::authoring {
namespace {

using test::DepthScore;

DepthOptions OptionsOf(DepthEstimator estimator) {
  DepthOptions options;
  options.estimator = estimator;
  options.gamma = 1.6;
  options.vignette = 0.3;
  options.low_percentile = 0;
  options.high_percentile = 100;
  return options;
}

DepthOptions Grey() {
  DepthOptions options = OptionsOf(DepthEstimator::kPaper);
  options.red_weight = options.green_weight = options.blue_weight = 1;
  return options;
}

bool IsOther(const DepthMap& a, const DepthMap& b) {
  return a.relief.size() != b.relief.size() ||
         std::memcmp(a.relief.data(), b.relief.data(), a.relief.size() * sizeof(float)) != 0;
}

DepthScore MeanScore(const DepthOptions& options, double tissue, double noise, double highlights) {
  DepthScore sum;
  constexpr int kSeeds = 4;
  for (int seed = 21; seed < 21 + kSeeds;
       ++seed) {  // other seeds than those that constants were chosen on
    const test::DepthScene scene =
        test::MakeDepthScene({seed, 240, tissue, noise, highlights, 1.6, 0.3});
    DepthReport report;
    const DepthMap relief = DepthFromColour(scene.picture, options, &report);
    const DepthScore score = test::ScoreScene(test::DistancesOf(relief, options, report), scene,
                                              options.estimator == DepthEstimator::kPaper);
    sum.abs_rel += score.abs_rel / kSeeds;
    sum.rmse_log += score.rmse_log / kSeeds;
    sum.within_125 += score.within_125 / kSeeds;
    sum.spearman += score.spearman / kSeeds;
    sum.contact_mm += score.contact_mm / kSeeds;
  }
  return sum;
}

TEST(DepthEstimators, ShadingReachesItsMarkOnMixedTissue) {
  const DepthScore shading = MeanScore(OptionsOf(DepthEstimator::kShading), 1, 0.01, 0.6);
  std::printf("shading, mixed tissue: %s\n", shading.Text().c_str());
  EXPECT_GE(shading.spearman, 0.76);
  EXPECT_LE(shading.abs_rel, 0.15);
}

// Rank correlation, which needs no fit; includes noise and highlights of the hardest kind.
TEST(DepthEstimators, NeitherIsEverWorseThanGrey) {
  for (const double tissue : {0.0, 1.0})
    for (const auto& [noise, highlights] : {std::pair{0.0, 0.0}, {0.01, 0.6}, {0.03, 1.5}}) {
      const DepthScore grey = MeanScore(Grey(), tissue, noise, highlights);
      std::printf("tissue %g noise %g: grey               %s\n", tissue, noise,
                  grey.Text().c_str());
      for (const DepthEstimator estimator :
           {DepthEstimator::kInverseSquareRed, DepthEstimator::kShading}) {
        const DepthScore score = MeanScore(OptionsOf(estimator), tissue, noise, highlights);
        std::printf("tissue %g noise %g: %-18s %s\n", tissue, noise,
                    estimator == DepthEstimator::kShading ? "shading" : "inverse-square-red",
                    score.Text().c_str());
        // On one tissue without noise all of them give the same order, except for smoothing: 0.01.
        EXPECT_GE(score.spearman, grey.spearman - 0.01);
      }
      const DepthScore shading =
          MeanScore(OptionsOf(DepthEstimator::kShading), tissue, noise, highlights);
      EXPECT_GE(shading.spearman, grey.spearman);
    }
}

TEST(DepthEstimators, RedTissueAtTheSameDistanceIsNotFurther) {
  // Pale and red halves at one distance, with the albedos of the model.
  ColourImage image(80, 60);
  const auto code = [](double light) {
    return static_cast<std::uint8_t>(std::lround(255 * std::pow(light, 1 / 1.6)));
  };
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) {
      std::uint8_t* p = image.at(x, y);
      const bool is_red = x < 40;
      p[0] = code(0.5 * (is_red ? 0.72 : 0.86));
      p[1] = code(0.5 * (is_red ? 0.36 : 0.80));
      p[2] = code(0.5 * (is_red ? 0.31 : 0.75));
    }
  DepthReport corrected, raw, grey;
  DepthOptions options = OptionsOf(DepthEstimator::kInverseSquareRed);
  options.vignette = 0;
  const auto ratio = [&](DepthReport& report) {
    const auto d = test::DistancesOf(DepthFromColour(image, options, &report), options, report);
    return d[30 * 80 + 10] / d[30 * 80 + 70];
  };
  EXPECT_NEAR(ratio(corrected), 1.0, 0.02);  // two grey levels of 8 bits
  options.correct_tissue = false;
  EXPECT_GT(ratio(raw), 1.06);  // √(.86 / .72) = 1.09
}

TEST(DepthEstimators, ASlantedPlaneIsLessDistortedWithShading) {
  // A plane tilted by 50° under a light at the scope; brightness = cosine / distance².
  constexpr int kSize = 200;
  ColourImage image(kSize, kSize);
  std::vector<double> truth;
  const glm::dvec3 normal = glm::normalize(glm::dvec3(std::sin(0.87), 0, -std::cos(0.87)));
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const glm::dvec3 ray = glm::normalize(glm::dvec3((x - 99.5) / 100, (y - 99.5) / 100, 1));
      const double cosine = -glm::dot(normal, ray);
      const double distance = std::cos(0.87) / std::max(cosine, 0.15);
      truth.push_back(cosine > 0.2 ? distance : std::numeric_limits<double>::quiet_NaN());
      const double light = std::clamp(0.35 * cosine / (distance * distance), 0.0, 1.0);
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] = static_cast<std::uint8_t>(255 * std::pow(light, 1 / 1.6) + 0.5);
    }
  const auto error = [&](DepthEstimator estimator) {
    DepthOptions options = OptionsOf(estimator);
    options.vignette = 0;
    options.correct_tissue = options.fill_highlights = false;
    options.surround_threshold = 0;
    DepthReport report;
    const DepthMap relief = DepthFromColour(image, options, &report);
    return test::ScoreDepth(test::DistancesOf(relief, options, report), truth, false).abs_rel;
  };
  const double plain = error(DepthEstimator::kInverseSquareRed),
               shading = error(DepthEstimator::kShading);
  std::printf("slanted plane, AbsRel: inverse-square %.3f, shading %.3f\n", plain, shading);
  EXPECT_LT(shading, 0.7 * plain);
}

TEST(DepthEstimators, GlintsAreFilled) {
  const ColourImage with = test::KneePicture(400, 300, 0.0, true),
                    without = test::KneePicture(400, 300, 0.0, false);
  for (const DepthEstimator estimator :
       {DepthEstimator::kInverseSquareRed, DepthEstimator::kShading}) {
    DepthOptions options = OptionsOf(estimator);
    options.vignette = 0;
    const auto error = [&](bool fill) {
      options.fill_highlights = fill;
      options.low_percentile = 5;  // so that the highlights do not set the range
      options.high_percentile = 95;
      const DepthMap found = DepthFromColour(with, options),
                     clean = DepthFromColour(without, options);
      double sum = 0;
      for (std::size_t i = 0; i < found.relief.size(); ++i)
        if (with.rgb[3 * i + 2] == 255 && !std::isnan(found.relief[i]))
          sum += std::abs(found.relief[i] - clean.relief[i]);
      return sum;
    };
    EXPECT_LT(error(true), 0.5 * error(false));
  }
}

TEST(DepthEstimators, KeepTheContractOfTheFilter) {
  const ColourImage knee = test::KneePicture(701, 333);
  const int threads = cv::getNumThreads();
  for (const DepthEstimator estimator :
       {DepthEstimator::kInverseSquareRed, DepthEstimator::kShading}) {
    DepthOptions options;
    options.estimator = estimator;
    cv::setNumThreads(1);
    const DepthMap alone = DepthFromColour(knee, options), paper = DepthFromColour(knee, {});
    cv::setNumThreads(3);
    const DepthMap again = DepthFromColour(knee, options);
    cv::setNumThreads(threads);
    float least = 1, most = -1;
    for (std::size_t i = 0; i < alone.relief.size(); ++i) {
      ASSERT_EQ(std::isnan(alone.relief[i]), std::isnan(paper.relief[i]));
      if (std::isnan(alone.relief[i])) continue;
      ASSERT_EQ(alone.relief[i], again.relief[i]);  // for any number of threads
      least = std::min(least, alone.relief[i]);
      most = std::max(most, alone.relief[i]);
    }
    EXPECT_EQ(least, static_cast<float>(options.far_relief));
    EXPECT_EQ(most, static_cast<float>(options.near_relief));
    // Smallest, black, uniform and empty pictures.
    EXPECT_TRUE(DepthFromColour(ColourImage{}, options).empty());
    EXPECT_TRUE(std::isnan(DepthFromColour(ColourImage(9, 7), options).at(3, 3)));
    for (const auto& [w, h] : {std::pair{1, 1}, {1, 40}, {40, 1}, {3, 2}}) {
      ColourImage flat(w, h);
      std::fill(flat.rgb.begin(), flat.rgb.end(), std::uint8_t{90});
      DepthReport report;
      for (const float value : DepthFromColour(flat, options, &report).relief)
        EXPECT_EQ(value, 0.0f);
      EXPECT_TRUE(report.is_flat);
    }
    std::atomic<bool> stop{true};
    Progress progress;
    progress.stop = &stop;
    EXPECT_THROW(DepthFromColour(knee, options, nullptr, progress), Error);
    options.vignette = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(DepthFromColour(knee, options), Error);
  }
}

TEST(DepthEstimators, PreviewLooksLikeTheWholeResult) {
  const ColourImage knee = test::KneePicture(1600, 800);
  const DepthPreview preview(knee);
  for (const DepthEstimator estimator :
       {DepthEstimator::kInverseSquareRed, DepthEstimator::kShading}) {
    DepthOptions options;
    options.estimator = estimator;
    const auto error = test::PreviewErrorOf(preview.Filter(options), DepthFromColour(knee, options),
                                            preview.Factor());
    std::printf("estimator %d: %s\n", static_cast<int>(estimator), error.Text().c_str());
    // Tolerance of a thirtieth of 20 mm: slopes are taken on a small picture either way, which
    // starts at other pixels. The preview is for choosing options.
    EXPECT_LT(error.mean, 0.0007);
    EXPECT_LT(error.disagree, 0.02);
  }
}

TEST(GuidedSmoothing, TakesNoiseAwayAndKeepsAStep) {
  cv::Mat values(60, 80, CV_32F), weight = cv::Mat::ones(60, 80, CV_32F);
  std::uint32_t random = 3;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) {
      random = random * 1664525u + 1013904223u;
      values.at<float>(y, x) =
          (x < 40 ? 1.0f : 2.0f) + 0.06f * (static_cast<float>(random >> 8) / (1 << 24) - 0.5f);
    }
  weight.col(0).setTo(0);
  values.col(0).setTo(1e6);  // has weight 0, so it must not spill
  const cv::Mat smooth = GuidedSmoothing(values, weight, 4, 0.1, 0.0);
  EXPECT_LT(std::abs(smooth.at<float>(30, 3) - 1), 0.02);
  EXPECT_LT(smooth.at<float>(30, 39), 1.1);
  EXPECT_GT(smooth.at<float>(30, 40), 1.9);
  cv::Scalar mean, before, after;
  cv::meanStdDev(values(cv::Rect(5, 5, 25, 50)), mean, before);
  cv::meanStdDev(smooth(cv::Rect(5, 5, 25, 50)), mean, after);
  EXPECT_LT(after[0], 0.4 * before[0]);
}

// Changes the field with the number `index` and gives its name.
struct FieldChange {
  int index;
  std::string name = {};
  template <class T, class R>
  void operator()(const char* field, T& value, const R& range, const char*, const char*) {
    if (index-- != 0) return;
    name = field;
    if constexpr (std::is_enum_v<T>)
      value = value == range.words[0].first ? range.words[1].first : range.words[0].first;
    else if constexpr (std::is_same_v<T, bool>)
      value = !value;
    else
      value = static_cast<T>(value == range.min ? range.min + 0.02 * (range.max - range.min)
                                                : 0.5 * (value + range.min));
  }
};

TEST(DepthOptions, AFieldHasAnEffectIffItChangesTheRelief) {
  const test::DepthScene scene = test::MakeDepthScene({21, 120, 1, 0.01, 0.6, 1.6, 0.3});
  for (const DepthEstimator estimator :
       {DepthEstimator::kPaper, DepthEstimator::kInverseSquareRed, DepthEstimator::kShading})
    for (const DepthLaw law : {DepthLaw::kLinear, DepthLaw::kInverseSquare}) {
      DepthOptions options = OptionsOf(estimator);
      options.law = law;
      options.surround_threshold = 40;
      const DepthMap before = DepthFromColour(scene.picture, options),
                     noise = NoiseOfDepth(before, options.texture_size);
      for (int i = 0;; ++i) {
        DepthOptions other = options;
        FieldChange change{i};
        other.Visit(change);
        if (change.name.empty()) break;
        // A threshold and a rim change the relief only where there is what they seek.
        const DepthMap after = DepthFromColour(scene.picture, other);
        const DepthMap noise_after = NoiseOfDepth(after, other.texture_size);
        const bool is_same = !IsOther(before, after) && !IsOther(noise, noise_after);
        const std::string words =
            change.name + " of estimator " + std::to_string(static_cast<int>(estimator));
        const bool is_certain =
            change.name != "surround_threshold" && change.name != "border_margin";
        if (!HasEffect(options, change.name)) {
          EXPECT_TRUE(is_same) << words;
        } else if (is_certain) {
          EXPECT_FALSE(is_same) << words;
        }
      }
    }
}

// The weights were refused although they are not used.
TEST(DepthOptions, WeightsOfZeroAreRefusedOnlyWhereTheyCount) {
  DepthOptions options;
  options.red_weight = options.green_weight = options.blue_weight = 0;
  EXPECT_THROW(CheckDepthOptions(options), Error);
  options.estimator = DepthEstimator::kShading;
  EXPECT_NO_THROW(CheckDepthOptions(options));
}

}  // namespace
}  // namespace arthro::authoring
