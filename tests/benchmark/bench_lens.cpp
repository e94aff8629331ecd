// Speed against error of the lens: the fit from six boards, and rectifying frames of 800 x 640.
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "authoring/lens/fit/lens_fit.h"
#include "authoring/lens/rectifier.h"
#include "simulation/core/units.h"
#include "tests/authoring/lens/board_picture.h"
#include "tests/benchmark/bench_report.h"

namespace arthro {
namespace {

Lens Truth() {
  Lens lens;
  lens.width = 800;
  lens.height = 640;
  lens.focal_px = 392;
  lens.cx = 402.5;
  lens.cy = 317.5;
  lens.circle = {402.5, 317.5, 300};
  return lens;
}

// Six tilted 9 x 7 boards, corners off by 0.06 px a coordinate, as found in rendered pictures.
std::vector<authoring::TargetView> Boards() {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.06);
  std::vector<authoring::TargetView> views;
  for (int v = 0; v < 6; ++v) {
    const test::BoardPlace place{0.4 * std::cos(v), 0.4 * std::sin(v), 0.1 * v, {0, 0, 9}};
    const glm::dmat3 turn = test::TurnOf(place);
    authoring::TargetView view;
    view.kind = authoring::TargetKind::kChessboard;
    for (int i = -4; i <= 4; ++i)
      for (int j = -3; j <= 3; ++j)
        if (const auto p = PixelFromRay(Truth(), place.middle + turn * glm::dvec3(i, j, 0)))
          view.points.push_back({{p->x + noise(random), p->y + noise(random)}, i, j});
    views.push_back(view);
  }
  return views;
}

}  // namespace
}  // namespace arthro

int main(int argc, char** argv) {
  using namespace arthro;
  test::BenchReport report("lens", argc, argv);
  const auto views = Boards();
  const Lens truth = Truth();
  for (const auto model :
       {authoring::FitModel::kEquisolid, authoring::FitModel::kEquidistant,
        authoring::FitModel::kDoubleSphere, authoring::FitModel::kKannalaBrandt}) {
    const auto Fit = [&] {
      const auto start = authoring::StartFit(views, {800, 640}, {402.5, 317.5}, 300);
      return authoring::FitLens(views, model, *start, {});
    };
    const Lens lens = Fit().lens.AsLens({800, 640});
    double worst = 0;
    for (double r = 5; r <= 285; r += 5)
      worst = std::max(
          worst, std::abs(RadiusFromAngle(lens, *AngleFromRadius(truth, r)).value_or(1e3) - r));
    report.Measure(
        fmt::format("start and fit, 6 boards, {}", WordOf(model)), 1,
        [&] { test::KeepAlive(Fit()); }, fmt::format("{:.2f} px at 95 % of the rim", worst), 30);
  }
  cv::Mat raw(640, 800, CV_8UC3, cv::Scalar(90, 120, 150)), rectified;
  for (const double scale : {1.0, 0.5, 0.25}) {
    const authoring::Rectifier rectifier(truth, {}, scale);
    const double megabytes = 800 * 640 * 3 * 1e-6;
    const auto timing = test::TimeCalls(3, 20, 1, [&] { rectifier.Rectify(raw, rectified); });
    report.Measure(
        fmt::format("rectify 800 x 640, scale {}", scale), 1,
        [&] { rectifier.Rectify(raw, rectified); },
        fmt::format("maps of 1/32 px; {:.0f} MB/s of raw", megabytes / timing.median), 60);
  }
  return 0;
}
