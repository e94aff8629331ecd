// Fit of a lens from six boards, and rectification of frames of 800 x 640.
#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "app/bench/micro/micro_bench.h"
#include "authoring/lens/fit/lens_fit.h"
#include "authoring/lens/rectifier.h"
#include "tests/support/board_picture.h"
#include "tests/support/round_lens.h"

namespace arthro::app {
namespace {

Lens Truth() { return test::RoundLens(800, 640, 392, 402.5, 317.5, 300); }

// Six tilted 9 x 7 boards; corners with noise of 0.06 px per coordinate, as detected in rendered
// pictures.
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

MicroGroup LensMicro(bool) {
  MicroGroup group{"lens",
                   "largest radius error up to 95 % of the rim, px",
                   "lens that rendered the targets",
                   {}};
  const auto views = MadeOnce(Boards);
  for (const auto model :
       {authoring::FitModel::kEquisolid, authoring::FitModel::kEquidistant,
        authoring::FitModel::kDoubleSphere, authoring::FitModel::kKannalaBrandt}) {
    const auto fit = [=] {
      const auto start = authoring::StartFit(views(), {800, 640}, {402.5, 317.5}, 300);
      return authoring::FitLens(views(), model, *start, {});
    };
    group.functions.push_back(
        {fmt::format("fit to 6 boards, {}", ToString(model)), [=] { KeepAlive(fit()); },
         [=] {
           const Lens truth = Truth(), lens = fit().lens.AsLens({800, 640});
           double worst = 0;
           for (double r = 5; r <= 285; r += 5)
             worst = std::max(
                 worst,
                 std::abs(RadiusFromAngle(lens, *AngleFromRadius(truth, r)).value_or(1e3) - r));
           return MicroError{worst, fmt::format("{:.2f} px", worst)};
         }});
  }
  for (const double scale : {1.0, 0.5, 0.25}) {
    struct Frames {
      authoring::Rectifier rectifier;
      cv::Mat raw, rectified;
    };
    const auto frames = MadeOnce([scale] {
      return Frames{authoring::Rectifier(Truth(), {}, scale),
                    cv::Mat(640, 800, CV_8UC3, cv::Scalar(90, 120, 150)),
                    {}};
    });
    group.functions.push_back({fmt::format("rectify 800 x 640, scale {}", scale),
                               [=] {
                                 Frames& f = frames();
                                 f.rectifier.Rectify(f.raw, f.rectified);
                               },
                               [] { return MicroError{.text = "maps of 1/32 px"}; }});
  }
  return group;
}

}  // namespace arthro::app
