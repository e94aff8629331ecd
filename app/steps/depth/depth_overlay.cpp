#include "app/steps/depth/depth_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/units.h"

namespace arthro::app {
namespace {

constexpr int kLongest = 2048;   // px of the drawn picture
constexpr double kCover = 0.45;  // share of a layer's colour

using Rgb = glm::dvec3;  // 0 to 255

constexpr std::array<Rgb, 4> kOriginColours = {Rgb(70, 70, 74), Rgb(70, 190, 120),
                                               Rgb(240, 180, 60), Rgb(120, 130, 240)};
// Dark blue, teal, green, yellow: even steps of lightness, also for the colour-blind.
constexpr std::array<Rgb, 5> kRamp = {Rgb(68, 1, 84), Rgb(59, 82, 139), Rgb(33, 145, 140),
                                      Rgb(94, 201, 98), Rgb(253, 231, 37)};

Rgb RampColour(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (kRamp.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), kRamp.size() - 2);
  return glm::mix(kRamp[low], kRamp[low + 1], at - static_cast<double>(low));
}

unsigned Packed(const Rgb& colour) {
  const auto byte = [](double value) { return static_cast<unsigned>(std::lround(value)); };
  return 0xFF000000u | byte(colour.z) << 16 | byte(colour.y) << 8 | byte(colour.x);
}

// Ranges between which almost all of the surface lies.
std::pair<double, double> UsualRanges(const authoring::Document& document) {
  std::vector<float> heights;
  const DepthMap& depth = *document.depth;
  const std::size_t stride = depth.relief.size() / 20000 + 1;
  for (std::size_t i = 0; i < depth.relief.size(); i += stride)
    if (!std::isnan(depth.relief[i])) heights.push_back(depth.relief[i]);
  if (heights.empty()) return {0, 1};
  std::sort(heights.begin(), heights.end());
  const double radius = document.scene.backdrop.radius;
  const std::size_t cut = heights.size() / 50;
  constexpr double kLeastSpan = 1e-4;  // m, so that a sphere has colours too
  const double near = radius - static_cast<double>(heights[heights.size() - 1 - cut]);
  return {near, std::max(radius - static_cast<double>(heights[cut]), near + kLeastSpan)};
}

class Layer {
 public:
  Layer(const authoring::Document& document, MapLayer layer)
      : document_(document), layer_(layer), fits_(Fits(document)) {
    if (layer_ == MapLayer::kRange && fits_) std::tie(near_, far_) = UsualRanges(document);
  }

  // Colour of a cell; false where the picture shows as it is.
  bool ColourOf(int x, int y, Rgb& colour) {
    if (!fits_ || layer_ == MapLayer::kPicture) return false;
    const double height = static_cast<double>(document_.depth->at(x, y));
    const ReliefOrigin origin = OriginAt(x, y, height);
    ++counts_[static_cast<std::size_t>(origin)];
    colour = kOriginColours[0];
    if (layer_ == MapLayer::kOrigin) colour = kOriginColours[static_cast<std::size_t>(origin)];
    if (std::isnan(height)) return true;
    if (layer_ == MapLayer::kRange)
      colour = RampColour((document_.scene.backdrop.radius - height - near_) / (far_ - near_));
    if (layer_ == MapLayer::kSigma && document_.depth_sigma)
      if (const float sigma = document_.depth_sigma->at(x, y); !std::isnan(sigma))
        colour = RampColour(static_cast<double>(sigma) / kMostShownSigma);
    return true;
  }

  MapLegend Legend() const {
    MapLegend legend;
    if (layer_ == MapLayer::kPicture) return legend;
    if (!fits_) {
      legend.entries.push_back({Packed(kOriginColours[0]), "There is no depth map yet."});
      return legend;
    }
    const bool is_unknown = !document_.depth_origin && document_.is_depth_imported;
    double all = 0;
    for (std::size_t i = 1; i < counts_.size(); ++i) all += counts_[i];
    const auto entry = [&](ReliefOrigin origin) {
      const auto at = static_cast<std::size_t>(origin);
      if (counts_[at] > 0 && !(is_unknown && at > 0))
        legend.entries.push_back({Packed(kOriginColours[at]),
                                  at == 0 ? std::string("no depth")
                                          : fmt::format("{}, {:.0f} %", WordsOfOrigin(origin),
                                                        100 * counts_[at] / std::max(1.0, all))});
    };
    if (layer_ == MapLayer::kOrigin) {
      for (const ReliefOrigin origin : {ReliefOrigin::kMeasured, ReliefOrigin::kBrightness,
                                        ReliefOrigin::kInterpolated, ReliefOrigin::kNone})
        entry(origin);
      if (is_unknown)
        legend.entries.push_back({Packed(kOriginColours[2]), "imported, origin not known"});
      return legend;
    }
    if (layer_ == MapLayer::kSigma && !document_.depth_sigma) {
      legend.entries.push_back({Packed(kOriginColours[0]), "The uncertainty is not known."});
      return legend;
    }
    for (int i = 0; i <= 16; ++i) legend.ramp.push_back(Packed(RampColour(i / 16.0)));
    if (layer_ == MapLayer::kSigma) {
      legend.ramp_words = "Standard error";
      legend.low = "0";
      legend.high = fmt::format("{:g} mm and more", MmFromMetres(kMostShownSigma));
    } else {
      legend.ramp_words = "Distance from the portal";
      legend.low = fmt::format("{:.0f}", MmFromMetres(near_));
      legend.high = fmt::format("{:.0f} mm", MmFromMetres(far_));
    }
    entry(ReliefOrigin::kNone);
    return legend;
  }

 private:
  static bool Fits(const authoring::Document& document) {
    const auto fits = [&](const auto& map) {
      return !map ||
             (map->width == document.panorama->width && map->height == document.panorama->height);
    };
    return document.depth && fits(document.depth) && fits(document.depth_sigma) &&
           fits(document.depth_origin);
  }
  ReliefOrigin OriginAt(int x, int y, double height) const {
    if (document_.depth_origin) return document_.depth_origin->at(x, y);
    return std::isnan(height) ? ReliefOrigin::kNone : ReliefOrigin::kBrightness;
  }

  const authoring::Document& document_;
  MapLayer layer_;
  bool fits_;
  double near_ = 0, far_ = 1;
  std::array<double, 4> counts_{};
};

}  // namespace

DrawnLayer DrawLayer(const authoring::Document& document, MapLayer layer) {
  DrawnLayer drawn;
  const ColourImage& panorama = *document.panorama;
  const int stride = (std::max(panorama.width, panorama.height) + kLongest - 1) / kLongest;
  drawn.picture =
      ColourImage(std::max(1, panorama.width / stride), std::max(1, panorama.height / stride));
  Layer colours(document, layer);
  for (int y = 0; y < drawn.picture.height; ++y)
    for (int x = 0; x < drawn.picture.width; ++x) {
      const int from_x = std::min(x * stride + stride / 2, panorama.width - 1),
                from_y = std::min(y * stride + stride / 2, panorama.height - 1);
      const std::uint8_t* from = panorama.at(from_x, from_y);
      std::uint8_t* to = drawn.picture.at(x, y);
      Rgb colour;
      const bool is_covered = colours.ColourOf(from_x, from_y, colour);
      for (int c = 0; c < 3; ++c)
        to[c] = is_covered ? static_cast<std::uint8_t>(
                                 std::lround((1 - kCover) * from[c] + kCover * colour[c]))
                           : from[c];
    }
  drawn.legend = colours.Legend();
  return drawn;
}

}  // namespace arthro::app
