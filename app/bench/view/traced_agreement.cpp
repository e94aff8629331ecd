#include "app/bench/view/traced_agreement.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace arthro::app {
namespace {

using namespace test;

constexpr double kWithin = 0.45;       // share of the picture's side, from its centre
constexpr double kPanoramaMargin = 9;  // px
constexpr int kMostRounds = 20;        // limit of the search for usable pixels

bool IsWellInside(const glm::dvec2& place, const ColourImage& panorama) {
  return place.x >= kPanoramaMargin && place.y >= kPanoramaMargin &&
         place.x <= panorama.width - 1 - kPanoramaMargin &&
         place.y <= panorama.height - 1 - kPanoramaMargin;
}

}  // namespace

std::vector<TracedPixel> TracePixels(const LoadedScene& loaded, const Picture& picture, int size,
                                     int count, std::span<const ReferenceMesh> meshes) {
  const Backdrop& backdrop = loaded.scene.backdrop;
  const auto wanted = static_cast<std::size_t>(count);
  std::mt19937 random(7);
  std::vector<TracedPixel> pixels;
  for (int round = 0; round < kMostRounds && pixels.size() < wanted; ++round) {
    std::vector<TracedPixel> tried;
    std::vector<glm::dvec3> rays;
    for (int i = 0; i < count; ++i) {
      const int x = static_cast<int>(random() % static_cast<unsigned>(size));
      const int y = static_cast<int>(random() % static_cast<unsigned>(size));
      if (std::hypot(x - 0.5 * (size - 1), y - 0.5 * (size - 1)) > kWithin * size) continue;
      const auto ray = ReferenceRay(picture.view, picture.field_of_view, size, {x, y});
      if (!ray) continue;
      tried.push_back({x, y, 0, {}});
      rays.push_back(*ray);
    }
    const std::vector<TracedRay> traced =
        TraceRays(backdrop, *loaded.panorama, picture.view.tip, rays, meshes, loaded.depth.get());
    for (std::size_t i = 0; i < traced.size() && pixels.size() < wanted; ++i) {
      const TracedRay& met = traced[i];
      if (met.what == TracedRay::kNothing) continue;
      if (met.what == TracedRay::kBackdrop) {
        const auto place =
            ReferencePixel(backdrop.projection, picture.view.tip + met.distance * rays[i]);
        if (!place || !IsWellInside(*place, *loaded.panorama)) continue;
      }
      pixels.push_back({tried[i].x, tried[i].y, met.distance, met.colour});
    }
  }
  return pixels;
}

TracedAgreement CompareWithTraced(std::span<const TracedPixel> traced,
                                  std::span<const float> distances, int size,
                                  const ColourImage* colours) {
  TracedAgreement agreement;
  agreement.compared = static_cast<int>(traced.size());
  int elsewhere = 0, off_colour = 0;
  double sum2 = 0;
  for (const TracedPixel& pixel : traced) {
    const std::size_t at = static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(size) +
                           static_cast<std::size_t>(pixel.x);
    const double off = std::abs(static_cast<double>(distances[at]) - pixel.distance);
    if (off > kSameDistance)
      ++elsewhere;
    else
      sum2 += off * off;
    if (!colours) continue;
    double worst = 0;
    for (int c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(colours->at(pixel.x, pixel.y)[c] - pixel.colour[c]));
    off_colour += worst > kSameColour ? 1 : 0;
  }
  const double all = std::max(1, agreement.compared);
  agreement.elsewhere = elsewhere / all;
  agreement.rms = std::sqrt(sum2 / std::max(1, agreement.compared - elsewhere));
  if (colours) agreement.off_colour = off_colour / all;
  return agreement;
}

}  // namespace arthro::app
