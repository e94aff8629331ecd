// Depth estimators on cavities whose distances are known: milliseconds of the process beside every
// error, at three levels of noise, with and without highlights, on one tissue and on several; and
// on the panorama of a digital knee. Grey with equal weights is the mark that none may fall short
// of.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "authoring/depth/depth_filter.h"
#include "authoring/phantom/phantom.h"
#include "tests/benchmark/bench_report.h"
#include "tests/support/depth_score.h"

using namespace arthro;
using namespace arthro::authoring;

namespace {

struct Way {
  const char* name;
  DepthOptions options;
};

std::vector<Way> Ways(double gamma, double vignette) {
  std::vector<Way> ways{{"grey", {}}, {"paper", {}}, {"inverse-square-red", {}}, {"shading", {}}};
  for (Way& way : ways) {
    way.options.gamma = gamma;
    way.options.vignette = vignette;
    way.options.low_percentile = 0;
    way.options.high_percentile = 100;
  }
  ways[0].options.red_weight = ways[0].options.green_weight = ways[0].options.blue_weight = 1;
  ways[2].options.estimator = DepthEstimator::kInverseSquareRed;
  ways[3].options.estimator = DepthEstimator::kShading;
  return ways;
}

struct Found {
  std::vector<double> distance;
  double seconds = 0;
};

Found Estimate(const ColourImage& picture, const DepthOptions& options) {
  DepthReport told;
  const std::clock_t start = std::clock();
  const DepthMap relief = DepthFromColour(picture, options, &told);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return {test::DistancesOf(relief, options, told), seconds};
}

void Print(const test::BenchReport& report, const std::string& what, std::vector<double> seconds,
           const test::DepthScore& score) {
  std::sort(seconds.begin(), seconds.end());
  report.Row(what, {seconds[seconds.size() / 2], seconds.back()}, score.Text());
}

}  // namespace

int main(int argc, char** argv) {
  const test::BenchReport report("depth against truth, CPU time", argc, argv);
  const int seeds = report.quick() ? 1 : 5;
  for (const double tissue : {0.0, 1.0})
    for (const double noise : {0.0, 0.01, 0.03})
      for (const double highlights : {0.0, 1.5}) {
        if (report.quick() && noise != 0.01) continue;
        for (const Way& way : Ways(1.6, 0.3)) {
          test::DepthScore mean;
          std::vector<double> seconds;
          for (int seed = 21; seed < 21 + seeds; ++seed) {
            const test::DepthScene scene =
                test::MakeDepthScene({seed, 240, tissue, noise, highlights, 1.6, 0.3});
            const Found found = Estimate(scene.picture, way.options);
            const test::DepthScore score = test::ScoreScene(
                found.distance, scene, way.options.estimator == DepthEstimator::kPaper);
            mean.abs_rel += score.abs_rel / seeds;
            mean.rmse_log += score.rmse_log / seeds;
            mean.within_125 += score.within_125 / seeds;
            mean.spearman += score.spearman / seeds;
            mean.contact_mm += score.contact_mm / seeds;
            seconds.push_back(found.seconds);
          }
          Print(report,
                fmt::format("{}, noise {:g} %, {}, {}", tissue > 0 ? "mixed" : "one tissue",
                            100 * noise, highlights > 0 ? "glints" : "no glints", way.name),
                seconds, mean);
        }
      }
  PhantomOptions options;
  options.size = PhantomSize::kSmall;
  const Phantom phantom = MakePhantom(options);
  std::vector<double> truth;
  for (const float h : phantom.with_tissues.depth.relief)
    truth.push_back(std::isnan(h) ? std::numeric_limits<double>::quiet_NaN()
                                  : 1 - h / phantom.cavity.radius);
  for (Way& way : Ways(2.2, 0)) {
    way.options.field_of_view = RadiansFromDegrees(150);  // of an equirectangular panorama
    const Found found = Estimate(phantom.with_tissues.colour, way.options);
    Print(report, fmt::format("panorama of a digital knee, {}", way.name), {found.seconds},
          test::ScoreDepth(found.distance, truth, way.options.estimator == DepthEstimator::kPaper));
  }
}
