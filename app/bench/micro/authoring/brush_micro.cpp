// A stroke of the brush that mends a depth map: a piece of its preview, and the parts of the work
// when the button is let go, beside the same on the whole map.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <thread>

#include <fmt/format.h>

#include "app/bench/micro/micro_bench.h"
#include "app/view/backdrop/backdrop_texture.h"
#include "app/view/backdrop/drawn_relief.h"
#include "authoring/depth/depth_filter.h"
#include "authoring/depth/noise/depth_noise.h"
#include "authoring/depth/strokes/growing_stroke.h"
#include "simulation/haptics/relief/relief_smoothing.h"
#include "tests/support/knee_picture.h"

namespace arthro::app {
namespace {

using namespace authoring;

// A depth map made from a picture, and a stroke across a part of it.
struct Drawn {
  std::shared_ptr<const ColourImage> panorama;
  MendedDepth before, after;
  Backdrop backdrop;
  DepthStroke stroke;
  PixelBounds changed;
};

Drawn MakeDrawn(int width) {
  Drawn drawn;
  drawn.panorama = std::make_shared<ColourImage>(test::KneePicture(width, width / 2, 1.5));
  const DepthOptions options;
  drawn.before.relief = DepthFromColour(*drawn.panorama, options);
  drawn.before.sigma = NoiseOfDepth(drawn.before.relief, options.texture_size);
  drawn.backdrop.radius = 0.05;
  drawn.backdrop.projection.type = ProjectionType::kGnomonic;
  drawn.backdrop.projection.centre_px = {0.5 * width, 0.25 * width};
  drawn.backdrop.projection.focal_px = 0.4 * width;
  drawn.stroke.radius = 0.01;
  for (int i = 0; i <= 40; ++i)
    drawn.stroke.points.emplace_back(0.4 + 0.002 * i, 0.2 + 0.02 * std::sin(0.2 * i));
  drawn.after = drawn.before;
  ApplyStroke(drawn.stroke, {*drawn.panorama, drawn.backdrop.projection, drawn.backdrop.radius},
              drawn.after);
  drawn.changed = Joined(DifferenceOf(drawn.before.relief, drawn.after.relief),
                         DifferenceOf(drawn.before.sigma, drawn.after.sigma));
  return drawn;
}

double WorstOff(const DepthMap& a, const DepthMap& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.relief.size(); ++i)
    if (std::isfinite(a.relief[i]) || std::isfinite(b.relief[i]))
      worst = std::max(worst, std::abs(static_cast<double>(a.relief[i]) - b.relief[i]));
  return worst;
}

// The work between letting the button go and the first picture with the stroke. The copy of the
// map, 64 MB, is there: it is made beside the window while the button is down (depth_brush.cpp).
class Release {
 public:
  explicit Release(const Drawn& drawn)
      : drawn_(drawn),
        size_(drawn.panorama->width, drawn.panorama->height),
        shown_(MakeDrawnRelief(size_, drawn.before.relief, drawn.before.sigma, drawn.backdrop,
                               NoiseRemoval::kRough)),
        copy_(drawn.before) {}

  // Waits for this: the tiles of the stroke.
  StrokeReport OnWindowThread() {
    const StrokeReport report = ApplyStroke(
        stroke(), {*drawn_.panorama, drawn_.backdrop.projection, drawn_.backdrop.radius}, copy_);
    is_raised_ = !is_raised_;
    return report;
  }
  // Beside the window: the relief that is shown, moved by the stroke, and its textures.
  DrawnRelief Beside() const {
    const ReliefMaps before{drawn_.before.relief, drawn_.before.sigma},
        after{copy_.relief, copy_.sigma};
    return WithShift(shown_, size_, before, after, drawn_.backdrop,
                     SmallChange(before, after).value_or(PixelBounds()));
  }
  // Beside the window after that: the same without the noise of the stroke.
  DrawnRelief Quiet() const {
    const ReliefMaps before{drawn_.before.relief, drawn_.before.sigma},
        after{copy_.relief, copy_.sigma};
    return WithChange(shown_, size_, after, drawn_.backdrop,
                      SmallChange(before, after).value_or(PixelBounds()));
  }
  const MendedDepth& map() const { return copy_; }

 private:
  // Every other call takes the stroke back, so that heights do not grow with the calls.
  DepthStroke stroke() const {
    DepthStroke stroke = drawn_.stroke;
    if (is_raised_) stroke.kind = StrokeKind::kLower;
    return stroke;
  }

  const Drawn& drawn_;
  glm::ivec2 size_;
  DrawnRelief shown_;
  MendedDepth copy_;
  bool is_raised_ = false;
};

MicroError ErrorOf(double metres) { return {1e6 * metres, fmt::format("{:.3g} um", 1e6 * metres)}; }

}  // namespace

MicroGroup BrushMicro(bool quick) {
  MicroGroup group{
      "brush", "worst difference of the relief, um", "the whole stroke, the whole map", {}};
  const int width = quick ? 512 : 4096;
  const auto drawn = MadeOnce([=] { return MakeDrawn(width); });
  for (const StrokeKind kind : {StrokeKind::kRaise, StrokeKind::kSmooth, StrokeKind::kFlatten}) {
    const auto coarse = MadeOnce([=] {
      DepthStroke stroke = drawn().stroke;
      stroke.kind = kind;
      const int side = std::min(1024, width);
      MendedDepth map{DepthMap(side, side / 2), {}, {}};
      for (int y = 0; y < side / 2; ++y)
        for (int x = 0; x < side; ++x)
          map.relief.at(x, y) = drawn().before.relief.at(x * width / side, y * width / side);
      Projection projection = drawn().backdrop.projection;
      projection.centre_px *= static_cast<double>(side) / width;
      projection.focal_px *= static_cast<double>(side) / width;
      GrowingStroke growing(stroke, nullptr, projection, drawn().backdrop.radius, std::move(map));
      growing.Add(stroke.points);
      return growing;
    });
    group.functions.push_back({fmt::format("piece of a preview, {}", ToString(kind)),
                               [=] {
                                 // To and fro at the end of the line.
                                 KeepAlive(coarse().Add({&drawn().stroke.points[38], 1}));
                               },
                               {}});
  }
  group.functions.push_back(
      {fmt::format("stroke at {} x {}", width, width / 2),
       [=] {
         MendedDepth depth = drawn().before;
         KeepAlive(ApplyStroke(
             drawn().stroke,
             {*drawn().panorama, drawn().backdrop.projection, drawn().backdrop.radius}, depth));
       },
       {}});
  const auto release = MadeOnce([=] { return std::make_shared<Release>(drawn()); });
  const auto error_of_release = [=] {
    Release own(drawn());
    own.OnWindowThread();
    return ErrorOf(std::max(WorstOff(own.map().relief, drawn().after.relief),
                            WorstOff(own.map().sigma, drawn().after.sigma)));
  };
  const std::string size = fmt::format("{}x{}", width, width / 2);
  group.functions.push_back({"release at " + size,
                             [=] {
                               KeepAlive(release()->OnWindowThread());
                               KeepAlive(release()->Beside());
                             },
                             error_of_release});
  group.functions.push_back({"release at " + size + ", window's thread",
                             [=] { KeepAlive(release()->OnWindowThread()); }, error_of_release});
  const auto released = MadeOnce([=] {
    auto made = std::make_shared<Release>(drawn());
    made->OnWindowThread();
    return made;
  });
  // Both at the same time, as in the window: the first picture after the release, and the quiet
  // one.
  group.functions.push_back({"full quality after it at " + size,
                             [=] {
                               const Release& made = *released();
                               const std::jthread first([&] { KeepAlive(made.Beside()); });
                               KeepAlive(made.Quiet());
                             },
                             {}});
  group.functions.push_back(
      {"the same alone at " + size, [=] { KeepAlive(released()->Quiet()); }, {}});
  group.functions.push_back(
      {"rectangle that differs between two maps",
       [=] { KeepAlive(DifferenceOf(drawn().before.relief, drawn().after.relief)); },
       {}});
  const auto noisy = MadeOnce([=] { return MakeDrawn(std::min(2048, width)); });
  // The noise of a whole map takes seconds, so the maps are half as wide, it is removed once, and
  // its time stands beside the error of the part.
  struct Whole {
    DepthMap relief;
    double cpu = 0;  // s
  };
  const auto whole = MadeOnce([=] {
    Whole made;
    const std::clock_t begin = std::clock();
    made.relief =
        simulation::WithoutNoise(noisy().after.relief, noisy().after.sigma, noisy().backdrop);
    made.cpu = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    return made;
  });
  group.functions.push_back(
      {fmt::format("noise around the stroke, {} px", std::min(2048, width)),
       [=] {
         KeepAlive(simulation::WithoutNoiseAround(noisy().after.relief, noisy().after.sigma,
                                                  noisy().backdrop, noisy().changed));
       },
       [=] {
         const simulation::QuietPart part = simulation::WithoutNoiseAround(
             noisy().after.relief, noisy().after.sigma, noisy().backdrop, noisy().changed);
         DepthMap pieced = simulation::WithoutNoise(noisy().before.relief, noisy().before.sigma,
                                                    noisy().backdrop);
         PutSampled(part.relief, part.box, {pieced.width, pieced.height}, pieced);
         MicroError error = ErrorOf(WorstOff(pieced, whole().relief));
         error.text += fmt::format(
             ", {:.0f} % of the pixels, whole map {:.2f} s",
             100.0 * part.read / (static_cast<double>(pieced.width) * pieced.height), whole().cpu);
         return error;
       }});
  const auto sampled = MadeOnce([=] { return SampledRelief(drawn().after.relief); });
  group.functions.push_back({"texture of the relief",
                             [=] {
                               KeepAlive(MakeReliefTexture({width, width / 2}, drawn().after.relief,
                                                           sampled(), false,
                                                           SampledRelief(drawn().after.sigma)));
                             },
                             {}});
  const auto texture = MadeOnce([=] {
    return MakeReliefTexture({width, width / 2}, drawn().after.relief, sampled(), false,
                             SampledRelief(drawn().after.sigma));
  });
  group.functions.push_back(
      {"slopes for the lamp", [=] { KeepAlive(MakeBroadSlopes(texture(), false, 10)); }, {}});
  return group;
}

}  // namespace arthro::app
