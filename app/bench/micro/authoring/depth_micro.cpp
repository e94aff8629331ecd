// Depth from colour against known distances, at three levels of noise, with and without highlights,
// on one tissue and on several, and on the panorama of a digital knee. Grey with equal weights is
// the baseline. Then the preview that follows a slider.
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "app/bench/micro/micro_bench.h"
#include "authoring/depth/depth_filter.h"
#include "authoring/depth/depth_preview.h"
#include "authoring/phantom/phantom.h"
#include "simulation/core/units.h"
#include "tests/support/depth_score.h"
#include "tests/support/knee_picture.h"
#include "tests/support/preview_error.h"

namespace arthro::app {
namespace {

using namespace authoring;

struct Estimator {
  const char* name;
  DepthOptions options;
  bool fits_origin() const { return options.estimator == DepthEstimator::kPaper; }
};

std::vector<Estimator> Estimators(double gamma, double vignette) {
  std::vector<Estimator> all{
      {"grey", {}}, {"paper", {}}, {"inverse-square-red", {}}, {"shading", {}}};
  for (Estimator& estimator : all) {
    estimator.options.gamma = gamma;
    estimator.options.vignette = vignette;
    estimator.options.low_percentile = 0;
    estimator.options.high_percentile = 100;
  }
  DepthOptions& grey = all[0].options;
  grey.red_weight = grey.green_weight = grey.blue_weight = 1;
  all[2].options.estimator = DepthEstimator::kInverseSquareRed;
  all[3].options.estimator = DepthEstimator::kShading;
  return all;
}

std::vector<double> Distances(const ColourImage& picture, const DepthOptions& options) {
  DepthReport report;
  const DepthMap relief = DepthFromColour(picture, options, &report);
  return test::DistancesOf(relief, options, report);
}

MicroError ErrorFrom(const test::DepthScore& score) { return {100 * score.abs_rel, score.Text()}; }

struct Knee {
  ColourImage colour;
  std::vector<double> distance;
};

Knee MakeKnee() {
  PhantomOptions options;
  options.size = PhantomSize::kSmall;
  Phantom phantom = MakePhantom(options);
  Knee knee{std::move(phantom.with_tissues.colour), {}};
  for (const float h : phantom.with_tissues.depth.relief)
    knee.distance.push_back(std::isnan(h) ? std::numeric_limits<double>::quiet_NaN()
                                          : 1 - h / phantom.cavity.radius);
  return knee;
}

}  // namespace

MicroGroup DepthMicro(bool quick) {
  MicroGroup group{
      "depth", "mean relative error of distance, %", "distances that rendered the pictures", {}};
  const int seeds = quick ? 1 : 5;
  for (const double tissue : {0.0, 1.0})
    for (const double noise : {0.0, 0.01, 0.03})
      for (const double highlights : {0.0, 1.5}) {
        if (quick && noise != 0.01) continue;
        const auto scenes = MadeOnce([=] {
          std::vector<test::DepthScene> made;
          for (int seed = 21; seed < 21 + seeds; ++seed)
            made.push_back(test::MakeDepthScene({seed, 240, tissue, noise, highlights, 1.6, 0.3}));
          return made;
        });
        for (const Estimator& estimator : Estimators(1.6, 0.3))
          group.functions.push_back(
              {fmt::format("{}, noise {:g} %, {}, {}", tissue > 0 ? "mixed" : "one tissue",
                           100 * noise, highlights > 0 ? "glints" : "no glints", estimator.name),
               [=] { KeepAlive(Distances(scenes()[0].picture, estimator.options)); },
               [=] {
                 test::DepthScore mean;
                 for (const test::DepthScene& scene : scenes()) {
                   const test::DepthScore score = test::ScoreScene(
                       Distances(scene.picture, estimator.options), scene, estimator.fits_origin());
                   mean.abs_rel += score.abs_rel / seeds;
                   mean.rmse_log += score.rmse_log / seeds;
                   mean.within_125 += score.within_125 / seeds;
                   mean.spearman += score.spearman / seeds;
                   mean.contact_mm += score.contact_mm / seeds;
                 }
                 return ErrorFrom(mean);
               }});
      }
  const auto knee = MadeOnce(MakeKnee);
  std::vector<Estimator> of_knee = Estimators(2.2, 0);
  of_knee.push_back({"paper, steps as narrow as in the picture", of_knee[1].options});
  of_knee.back().options.step_width = 0;
  of_knee.push_back({"paper, step width 30 %", of_knee[1].options});
  of_knee.back().options.step_width = 30;
  for (Estimator& estimator : of_knee) {
    // The panorama is equirectangular.
    estimator.options.field_of_view = RadiansFromDegrees(150);
    group.functions.push_back({fmt::format("digital knee, {}", estimator.name),
                               [=] { KeepAlive(Distances(knee().colour, estimator.options)); },
                               [=] {
                                 return ErrorFrom(
                                     test::ScoreDepth(Distances(knee().colour, estimator.options),
                                                      knee().distance, estimator.fits_origin()));
                               }});
  }
  return group;
}

MicroGroup PreviewMicro(bool quick) {
  MicroGroup group{"preview",
                   "mean error of the relief, mm",
                   "filter of the whole panorama, averaged over the preview's pixels",
                   {}};
  const int width = quick ? 512 : 4096, height = width / 2;
  const auto panorama = MadeOnce([=] { return test::KneePicture(width, height); });
  for (const int radius : {2, 5}) {
    DepthOptions options;
    options.median_radius = radius;
    group.functions.push_back({fmt::format("{} x {}, median radius {}", width, height, radius),
                               [=] { KeepAlive(DepthFromColour(panorama(), options)); },
                               [] { return MicroError{.text = "is the reference"}; }});
  }
  group.functions.push_back(
      {"pyramid of the preview", [=] { KeepAlive(DepthPreview(panorama())); }, {}});
  const auto preview = MadeOnce([=] { return std::make_shared<DepthPreview>(panorama()); });
  for (const DepthLaw law : {DepthLaw::kLinear, DepthLaw::kInverseSquare}) {
    DepthOptions options;
    options.law = law;
    group.functions.push_back(
        {fmt::format("preview, {}", law == DepthLaw::kLinear ? "linear" : "inverse-square"),
         [=] { KeepAlive(preview()->Filter(options)); },
         [=] {
           const auto error =
               test::PreviewErrorOf(preview()->Filter(options),
                                    DepthFromColour(panorama(), options), preview()->Factor());
           return MicroError{1e3 * error.mean, error.Text()};
         }});
  }
  return group;
}

}  // namespace arthro::app
