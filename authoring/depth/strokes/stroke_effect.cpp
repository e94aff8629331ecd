#include "authoring/depth/strokes/stroke_effect.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "authoring/depth/grey_plane.h"
#include "authoring/relief/editing/wrong_cells.h"
#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// Height that a pixel goes to at full weight; NaN: it stays.
using TargetOf = std::function<double(int x, int y, double height)>;

// A copy of the part of the relief that a stroke reads.
struct Part {
  PixelBounds box;
  std::vector<float> height;

  Part(const DepthMap& relief, const PixelBounds& from) : box(from) {
    height.reserve(static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height()));
    for (int y = box.top; y < box.bottom; ++y)
      for (int x = box.left; x < box.right; ++x) height.push_back(relief.at(x, y));
  }
  double At(int x, int y) const {
    return static_cast<double>(
        height[static_cast<std::size_t>(y - box.top) * static_cast<std::size_t>(box.width()) +
               static_cast<std::size_t>(x - box.left)]);
  }
  // Bilinear; NaN beside unknown pixels and outside the part.
  double AtPoint(const glm::dvec2& at) const {
    const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
    if (x < box.left || y < box.top || x + 1 >= box.right || y + 1 >= box.bottom)
      return std::numeric_limits<double>::quiet_NaN();
    const double s = at.x - x, t = at.y - y;
    return (1 - t) * ((1 - s) * At(x, y) + s * At(x + 1, y)) +
           t * ((1 - s) * At(x, y + 1) + s * At(x + 1, y + 1));
  }
};

template <class Use>  // use(x, y, weight)
void ForPixels(const StrokeTile& tile, Use&& use) {
  for (int row = 0; row < tile.height; ++row)
    for (int column = 0; column < tile.width; ++column)
      if (const float weight = tile.WeightAt(column, row); weight > 0)
        use(tile.x + column, tile.y + row, static_cast<double>(weight));
}

// Mean height over a square window, by sums along rows and columns of one tile and its margin.
class WindowMeans {
 public:
  WindowMeans(const DepthMap& relief, const StrokeTile& tile, int reach) : reach_(reach) {
    const PixelBounds own{tile.x, tile.y, tile.x + tile.width, tile.y + tile.height};
    box_ = Grown(own, reach, relief.width, relief.height);
    stride_ = box_.width() + 1;
    const auto size =
        static_cast<std::size_t>(stride_) * static_cast<std::size_t>(box_.height() + 1);
    sum_.assign(size, 0);
    count_.assign(size, 0);
    for (int y = box_.top; y < box_.bottom; ++y)
      for (int x = box_.left; x < box_.right; ++x) {
        const double height = static_cast<double>(relief.at(x, y));
        const bool is_known = !std::isnan(height);
        const std::size_t at = Index(x + 1, y + 1);
        const std::size_t above = Index(x + 1, y), left = Index(x, y + 1), corner = Index(x, y);
        sum_[at] = sum_[above] + sum_[left] - sum_[corner] + (is_known ? height : 0);
        count_[at] = count_[above] + count_[left] - count_[corner] + (is_known ? 1 : 0);
      }
  }
  double At(int x, int y) const {
    const int left = std::max(box_.left, x - reach_), top = std::max(box_.top, y - reach_),
              right = std::min(box_.right, x + reach_ + 1),
              bottom = std::min(box_.bottom, y + reach_ + 1);
    return Over(sum_, left, top, right, bottom) / Over(count_, left, top, right, bottom);
  }

 private:
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>((y - box_.top) * stride_ + x - box_.left);
  }
  double Over(const std::vector<double>& table, int left, int top, int right, int bottom) const {
    return table[Index(right, bottom)] - table[Index(left, bottom)] - table[Index(right, top)] +
           table[Index(left, top)];
  }

  int reach_, stride_ = 0;
  PixelBounds box_;
  std::vector<double> sum_, count_;
};

double LuminanceAt(const ColourImage& panorama, int x, int y) {
  const std::uint8_t* p = panorama.at(x, y);
  return (0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]) / 255.0;
}

// The plane n·x = d as m = n/d, for which 1/r = m·direction. Nothing where the pixels span none.
std::optional<glm::dvec3> PlaneOf(const StrokeSums& sums) {
  const double size = sums.normal[0][0] + sums.normal[1][1] + sums.normal[2][2];
  constexpr double kLeastSpread = 1e-15;  // share of the cube; below it the solution is noise
  if (sums.count < 3 || !(glm::determinant(sums.normal) > kLeastSpread * size * size * size))
    return {};
  return glm::inverse(sums.normal) * sums.right;
}

TargetOf FlatteningTarget(const StrokeSums& sums, const MendedScene& scene) {
  return [plane = PlaneOf(sums), &scene](int x, int y, double) {
    if (!plane) return std::numeric_limits<double>::quiet_NaN();
    const double inverse = glm::dot(*plane, DirectionFromPixel(scene.projection, glm::dvec2(x, y)));
    // A plane that passes behind the portal or the horizon says nothing.
    const double range = 1 / inverse;
    return inverse > 0 && range < 2 * scene.radius ? scene.radius - range
                                                   : std::numeric_limits<double>::quiet_NaN();
  };
}

TargetOf BrightnessTarget(const DepthStroke& stroke, const StrokeSums& sums,
                          const MendedScene& scene) {
  const double height = sums.heights / sums.weights, grey = sums.greys / sums.weights;
  return [=, &scene, amount = stroke.amount](int x, int y, double) {
    return height + amount * (LuminanceAt(scene.panorama, x, y) - grey);
  };
}

// Heights on each side of the line are those at the rim of that side.
TargetOf EdgeTarget(const StrokeFootprint& footprint, const Part& before) {
  return [&footprint, &before](int x, int y, double) {
    const glm::dvec2 at(x, y);
    const LineFoot foot = NearestOnLine(footprint.points(), at);
    if (foot.is_past_end || !std::isfinite(foot.distance))
      return std::numeric_limits<double>::quiet_NaN();
    const double side = glm::dot(at - foot.point, foot.normal) < 0 ? -1 : 1;
    return before.AtPoint(foot.point + side * footprint.radius() * foot.normal);
  };
}

// Writes the new height of a pixel, with its standard error and origin.
void Put(MendedDepth& depth, int x, int y, double height, double calmed) {
  float& relief = depth.relief.at(x, y);
  const double change = height - static_cast<double>(relief);
  relief = static_cast<float>(height);
  const bool is_measured = !depth.origin.empty();
  if (!depth.sigma.empty()) {
    float& sigma = depth.sigma.at(x, y);
    const double before = static_cast<double>(sigma);
    sigma = static_cast<float>(is_measured ? std::hypot(before, change) : before * (1 - calmed));
  }
  if (is_measured && change != 0) depth.origin.at(x, y) = ReliefOrigin::kInterpolated;
}

void Forget(MendedDepth& depth, const StrokeTile& tile) {
  ForPixels(tile, [&](int x, int y, double weight) {
    if (weight < 0.5) return;
    depth.relief.at(x, y) = kUnknown;
    if (!depth.sigma.empty()) depth.sigma.at(x, y) = kUnknown;
    if (!depth.origin.empty()) depth.origin.at(x, y) = ReliefOrigin::kNone;
  });
}

template <class Map, class Value>
Map CutOut(const Map& map, const PixelBounds& box, std::vector<Value> Map::*values) {
  Map part;
  if (map.empty()) return part;
  part = Map(box.width(), box.height());
  for (int y = 0; y < box.height(); ++y) {
    const auto from =
        (map.*values).begin() + (static_cast<std::ptrdiff_t>(box.top) + y) * map.width + box.left;
    std::copy(from, from + box.width(),
              (part.*values).begin() + static_cast<std::ptrdiff_t>(y) * box.width());
  }
  return part;
}

template <class Map, class Value>
void PutBack(const Map& part, const PixelBounds& box, std::vector<Value> Map::*values, Map& map) {
  if (map.empty()) return;
  for (int y = 0; y < box.height(); ++y) {
    const auto from = (part.*values).begin() + static_cast<std::ptrdiff_t>(y) * box.width();
    std::copy(
        from, from + box.width(),
        (map.*values).begin() + (static_cast<std::ptrdiff_t>(box.top) + y) * map.width + box.left);
  }
}

// Share by which a stroke removes the noise of an estimated map.
double CalmedBy(const DepthStroke& stroke) {
  const bool is_smoothing = stroke.kind == StrokeKind::kSmooth ||
                            stroke.kind == StrokeKind::kFlatten || stroke.kind == StrokeKind::kEdge;
  return is_smoothing ? stroke.strength : 0.0;
}

}  // namespace

void StrokeSums::Add(const StrokeSums& other) {
  normal += other.normal;
  right += other.right;
  count += other.count;
  weights += other.weights, heights += other.heights, greys += other.greys;
}

bool HasSums(StrokeKind kind) {
  return kind == StrokeKind::kFlatten || kind == StrokeKind::kBrightness;
}

StrokeSums SumsOf(const DepthStroke& stroke, const MendedScene& scene, const DepthMap& before,
                  const StrokeTile& tile) {
  StrokeSums sums;
  const bool is_plane = stroke.kind == StrokeKind::kFlatten;
  ForPixels(tile, [&](int x, int y, double weight) {
    const double height = static_cast<double>(before.at(x, y));
    if (std::isnan(height)) return;
    if (!is_plane) {
      sums.weights += weight;
      sums.heights += weight * height;
      sums.greys += weight * LuminanceAt(scene.panorama, x, y);
      return;
    }
    const double range = scene.radius - height;
    if (!(range > 0)) return;
    const glm::dvec3 direction = DirectionFromPixel(scene.projection, glm::dvec2(x, y));
    // An error of the range counts alike near and far: d(1/r) = dr / r².
    const double w = weight * range * range * range * range;
    sums.normal += w * glm::outerProduct(direction, direction);
    sums.right += w / range * direction;
    ++sums.count;
  });
  return sums;
}

void CheckPicture(const DepthStroke& stroke, const MendedScene& scene, const DepthMap& relief) {
  if (stroke.kind == StrokeKind::kBrightness &&
      (scene.panorama.width != relief.width || scene.panorama.height != relief.height))
    throw Error(Code::kBadArgument,
                "a stroke copies from brightness, but the picture does not have the size of the "
                "depth map; give the picture that the map was made from");
}

void CloseMasked(std::span<const StrokeTile* const> tiles, const MendedScene& scene,
                 MendedDepth& depth) {
  const PixelBounds box = Grown(BoxOf(tiles), 1, depth.relief.width, depth.relief.height);
  CellMarks marks(box.width(), box.height());
  for (const StrokeTile* tile : tiles)
    ForPixels(*tile, [&](int x, int y, double) {
      marks
          .is_marked[static_cast<std::size_t>(y - box.top) * static_cast<std::size_t>(box.width()) +
                     static_cast<std::size_t>(x - box.left)] = 1;
    });
  Projection projection = scene.projection;
  projection.centre_px -= glm::dvec2(box.left, box.top);
  const DepthMap relief = CutOut(depth.relief, box, &DepthMap::relief),
                 sigma = CutOut(depth.sigma, box, &DepthMap::relief);
  const OriginMap origin = CutOut(depth.origin, box, &OriginMap::origin);
  const ClosedRelief closed = CloseMarked({relief, sigma, origin, projection, scene.radius}, marks);
  PutBack(closed.relief, box, &DepthMap::relief, depth.relief);
  PutBack(closed.sigma, box, &DepthMap::relief, depth.sigma);
  PutBack(closed.origin, box, &OriginMap::origin, depth.origin);
}

void ApplyToTiles(const DepthStroke& stroke, const MendedScene& scene,
                  const StrokeFootprint& footprint, const StrokeSums& sums,
                  std::span<const StrokeTile* const> tiles, const DepthMap& before,
                  MendedDepth& depth) {
  // The heights that targets read are those before the stroke.
  const int reach = static_cast<int>(std::ceil(footprint.radius())) + 2;
  const bool is_smooth = stroke.kind == StrokeKind::kSmooth;
  const bool is_edge = stroke.kind == StrokeKind::kEdge;
  const Part part(
      before, is_edge ? Grown(BoxOf(tiles), reach, before.width, before.height) : PixelBounds());
  TargetOf target;
  if (stroke.kind == StrokeKind::kFlatten) target = FlatteningTarget(sums, scene);
  if (stroke.kind == StrokeKind::kBrightness) target = BrightnessTarget(stroke, sums, scene);
  if (is_edge) target = EdgeTarget(footprint, part);
  std::vector<WindowMeans> means;
  const int window = std::max(1, static_cast<int>(std::lround(0.5 * footprint.radius())));
  if (is_smooth)
    for (const StrokeTile* tile : tiles) means.emplace_back(before, *tile, window);

  const double lift = stroke.kind == StrokeKind::kRaise   ? stroke.amount
                      : stroke.kind == StrokeKind::kLower ? -stroke.amount
                                                          : 0.0;
  ForStripsOfRows(static_cast<int>(tiles.size()), [&](int first, int last) {
    for (int t = first; t < last; ++t) {
      const auto at = static_cast<std::size_t>(t);
      const StrokeTile& tile = *tiles[at];
      if (stroke.kind == StrokeKind::kUnknown) {
        Forget(depth, tile);
        continue;
      }
      ForPixels(tile, [&](int x, int y, double weight) {
        const double height = static_cast<double>(depth.relief.at(x, y));
        if (std::isnan(height)) return;
        if (lift != 0) return Put(depth, x, y, height + weight * lift, 0);
        const double goal = is_smooth ? means[at].At(x, y) : target ? target(x, y, height) : height;
        if (!std::isfinite(goal)) return;
        Put(depth, x, y, height + weight * stroke.strength * (goal - height),
            weight * CalmedBy(stroke));
      });
    }
  });
}

}  // namespace arthro::authoring
