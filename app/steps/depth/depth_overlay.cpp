#include "app/steps/depth/depth_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "authoring/depth/grey_plane.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

constexpr int kLongest = 2048;   // px of the drawn picture
constexpr double kCover = 0.45;  // share of a layer's colour

using Rgb = glm::dvec3;  // 0 to 255

constexpr std::array<Rgb, 4> kOriginColours = {Rgb(70, 70, 74), Rgb(70, 190, 120),
                                               Rgb(240, 180, 60), Rgb(120, 130, 240)};
constexpr Rgb kGlint = Rgb(80, 200, 250), kMasked = Rgb(240, 90, 90), kKept = Rgb(110, 210, 110);
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
  // `live`: heights in place of the document's; null: those of the document.
  Layer(const authoring::Document& document, MapLayer layer, int stride,
        const DepthMap* live = nullptr)
      : document_(document), layer_(layer), stride_(stride), live_(live), fits_(Fits(document)) {
    if (layer_ == MapLayer::kRange && fits_) std::tie(near_, far_) = UsualRanges(document);
    if (layer_ == MapLayer::kMasks && !live) FindMasks();
  }

  // Colour of a cell; false where the picture shows as it is.
  bool ColourOf(int x, int y, Rgb& colour) {
    if (layer_ == MapLayer::kMasks) return MaskColour(x, y, colour);
    if (!fits_ || layer_ == MapLayer::kPicture) return false;
    const double height = HeightAt(x, y);
    const ReliefOrigin origin = OriginAt(x, y, height);
    ++counts_[static_cast<std::size_t>(origin)];
    colour = kOriginColours[0];
    if (layer_ == MapLayer::kOrigin) colour = kOriginColours[static_cast<std::size_t>(origin)];
    if (std::isnan(height)) return true;
    if (layer_ == MapLayer::kShape) colour = Rgb(255 * ShadeAt(x, y));
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
    if (layer_ == MapLayer::kMasks) {
      legend.entries.push_back({Packed(kGlint), "glint, found"});
      legend.entries.push_back({Packed(kMasked), "mask, painted"});
      legend.entries.push_back({Packed(kKept), "not a glint, painted"});
      return legend;
    }
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
    if (layer_ == MapLayer::kShape) {
      entry(ReliefOrigin::kNone);
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
  double HeightAt(int x, int y) const {
    if (live_)
      return static_cast<double>(live_->at(std::min(x / stride_, live_->width - 1),
                                           std::min(y / stride_, live_->height - 1)));
    return static_cast<double>(document_.depth->at(x, y));
  }
  // Diffuse shade, 0 to 1, of a lamp at the upper left. Slopes are taken over kShapeReach coarse
  // pixels, so that texture does not hide the shape.
  double ShadeAt(int x, int y) const {
    const int reach = kShapeReach * stride_;
    const auto along = [&](int dx, int dy) {
      const int x0 = std::max(0, x - dx), x1 = std::min(document_.depth->width - 1, x + dx),
                y0 = std::max(0, y - dy), y1 = std::min(document_.depth->height - 1, y + dy);
      return (HeightAt(x0, y0) - HeightAt(x1, y1)) / (x1 - x0 + y1 - y0);
    };
    const double right = along(reach, 0), below = along(0, reach);
    if (std::isnan(right) || std::isnan(below)) return 0.5;
    const Projection& projection = document_.scene.backdrop.projection;
    const double per_radian = projection.type == ProjectionType::kGnomonic
                                  ? projection.focal_px
                                  : DegreesFromRadians(1) * projection.px_per_deg;
    const double pixel = document_.scene.backdrop.radius / per_radian;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(right / pixel, below / pixel, 1.0));
    const glm::dvec3 lamp = glm::normalize(glm::dvec3(-1, -1, 1.4));
    return std::clamp(glm::dot(normal, lamp), 0.0, 1.0);
  }
  void FindMasks() {
    const ColourImage& panorama = *document_.panorama;
    glints_ = authoring::FoundHighlights(panorama, document_.depth_options);
    marks_ = authoring::MarksOf(OrEmpty(document_.depth_strokes), panorama.width, panorama.height);
  }
  bool MaskColour(int x, int y, Rgb& colour) const {
    const std::size_t at =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(document_.panorama->width) +
        static_cast<std::size_t>(x);
    const auto mark = at < marks_.size() ? marks_[at] : authoring::DepthMark::kNone;
    if (mark == authoring::DepthMark::kMasked)
      colour = kMasked;
    else if (mark == authoring::DepthMark::kKept)
      colour = kKept;
    else if (at < glints_.size() && glints_[at])
      colour = kGlint;
    else
      return false;
    return true;
  }
  ReliefOrigin OriginAt(int x, int y, double height) const {
    if (document_.depth_origin) return document_.depth_origin->at(x, y);
    return std::isnan(height) ? ReliefOrigin::kNone : ReliefOrigin::kBrightness;
  }

  const authoring::Document& document_;
  MapLayer layer_;
  int stride_;
  const DepthMap* live_;
  bool fits_;
  std::vector<std::uint8_t> glints_;
  std::vector<authoring::DepthMark> marks_;
  double near_ = 0, far_ = 1;
  std::array<double, 4> counts_{};
};

}  // namespace

namespace {

void DrawPixel(Layer& colours, MapLayer layer, int x, int y, const std::uint8_t* from,
               std::uint8_t* to) {
  const double cover = layer == MapLayer::kShape ? 1.0 : layer == MapLayer::kMasks ? 0.75 : kCover;
  Rgb colour;
  const bool is_covered = colours.ColourOf(x, y, colour);
  for (int c = 0; c < 3; ++c)
    to[c] = is_covered
                ? static_cast<std::uint8_t>(std::lround((1 - cover) * from[c] + cover * colour[c]))
                : from[c];
}

}  // namespace

DrawnLayer DrawLayer(const authoring::Document& document, MapLayer layer) {
  DrawnLayer drawn;
  const ColourImage& panorama = *document.panorama;
  const int stride = (std::max(panorama.width, panorama.height) + kLongest - 1) / kLongest;
  drawn.picture =
      ColourImage(std::max(1, panorama.width / stride), std::max(1, panorama.height / stride));
  Layer colours(document, layer, stride);
  for (int y = 0; y < drawn.picture.height; ++y)
    for (int x = 0; x < drawn.picture.width; ++x) {
      const int from_x = std::min(x * stride + stride / 2, panorama.width - 1),
                from_y = std::min(y * stride + stride / 2, panorama.height - 1);
      DrawPixel(colours, layer, from_x, from_y, panorama.at(from_x, from_y),
                drawn.picture.at(x, y));
    }
  drawn.legend = colours.Legend();
  return drawn;
}

ColourImage DrawCoarse(const authoring::Document& document, MapLayer layer, const CoarseMap& coarse,
                       const PixelBounds& box) {
  ColourImage picture(box.width(), box.height());
  Layer colours(document, layer, coarse.stride, &coarse.depth);
  for (int y = box.top; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; ++x)
      DrawPixel(colours, layer,
                std::min(x * coarse.stride + coarse.stride / 2, document.panorama->width - 1),
                std::min(y * coarse.stride + coarse.stride / 2, document.panorama->height - 1),
                coarse.picture.at(x, y), picture.at(x - box.left, y - box.top));
  return picture;
}

ColourImage GreyPicture(const ColourImage& panorama, const authoring::DepthOptions& options) {
  std::vector<std::uint8_t> flags;
  const authoring::GreyPlane plane = authoring::GreyFromColour(panorama, options, flags);
  ColourImage picture(panorama.width, panorama.height);
  for (std::size_t i = 0; i < plane.grey.size(); ++i)
    std::fill_n(&picture.rgb[3 * i], 3, static_cast<std::uint8_t>(plane.grey[i] / 256));
  return picture;
}

ColourImage FilteredPicture(const authoring::DepthPreview& pyramid,
                            const authoring::Document& document) {
  const ColourImage& level = pyramid.Picture();
  const authoring::DepthOptions& options = document.depth_options;
  ColourImage picture(level.width, level.height);
  DepthMap relief;
  try {
    relief = pyramid.Filter(
        options, nullptr, authoring::DepthPreview::kMostPixels,
        authoring::MarksOf(OrEmpty(document.depth_strokes), level.width, level.height));
  } catch (const Error&) {
    return picture;  // the options contradict each other, which the page says
  }
  const double span = std::max(options.near_relief - options.far_relief, 1e-9);
  for (std::size_t i = 0; i < relief.relief.size(); ++i) {
    if (std::isnan(relief.relief[i])) continue;
    const double share = (static_cast<double>(relief.relief[i]) - options.far_relief) / span;
    std::fill_n(&picture.rgb[3 * i], 3,
                static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0))));
  }
  return picture;
}

}  // namespace arthro::app
