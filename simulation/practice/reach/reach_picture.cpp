#include "simulation/practice/reach/reach_picture.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace arthro::simulation {
namespace {

constexpr int kShare = 45;  // percent of the colour in the picture

// Colours that colour-blind readers tell apart.
constexpr std::array<ReachColour, 5> kColours = {
    ReachColour{{90, 90, 90}, "neither"},
    {{86, 180, 233}, "seen only"},
    {{213, 94, 0}, "touched only"},
    {{240, 228, 66}, "seen and touched"},
    {{0, 158, 115}, "seen and touched, rods at 45° to 75°"},
};

// Colours of the relief's places on their grid of pixels; none where nothing was imaged.
class CellGrid {
 public:
  CellGrid(const ColourImage& panorama, const ScopeReach& scope, const PortalReach& reach)
      : step_(scope.pixel_step),
        half_(step_ / 2),
        columns_(panorama.width / step_ + 1),
        rows_(panorama.height / step_ + 1),
        cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    for (std::size_t i = 0; i < scope.places.size(); ++i)
      if (const ReachPlace& place = scope.places[i]; place.tissue < 0 && place.point < 0)
        cells_[IndexOf(static_cast<int>(place.pixel.x) / step_,
                       static_cast<int>(place.pixel.y) / step_)] =
            &ColourOf(ClassOf(reach.places[i]));
  }

  // Mixed from the four cells around; none where the pixel's own cell has none.
  std::optional<std::array<int, 3>> ColourAt(int x, int y) const {
    if (cells_[IndexOf(x / step_, y / step_)] == nullptr) return {};
    const double u = (x - half_) / static_cast<double>(step_),
                 v = (y - half_) / static_cast<double>(step_);
    const int left = static_cast<int>(std::floor(u)), top = static_cast<int>(std::floor(v));
    std::array<double, 3> sum{};
    double whole = 0;
    for (int j = top; j <= top + 1; ++j)
      for (int i = left; i <= left + 1; ++i) {
        if (i < 0 || j < 0 || i >= columns_ || j >= rows_) continue;
        const ReachColour* cell = cells_[IndexOf(i, j)];
        if (cell == nullptr) continue;
        const double weight = (1 - std::abs(u - i)) * (1 - std::abs(v - j));
        whole += weight;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * cell->rgb[c];
      }
    if (!(whole > 0)) return {};
    return std::array{static_cast<int>(sum[0] / whole), static_cast<int>(sum[1] / whole),
                      static_cast<int>(sum[2] / whole)};
  }

 private:
  std::size_t IndexOf(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int step_, half_, columns_, rows_;
  std::vector<const ReachColour*> cells_;
};

}  // namespace

const ReachColour& ColourOf(ReachClass reached) {
  return kColours[static_cast<std::size_t>(reached)];
}

ReachClass ClassOf(const PlaceReach& place) {
  if (place.is_good) return ReachClass::kGood;
  if (place.is_seen && place.is_touched) return ReachClass::kBoth;
  if (place.is_seen) return ReachClass::kSeen;
  return place.is_touched ? ReachClass::kTouched : ReachClass::kNeither;
}

ColourImage DrawReach(const ColourImage& panorama, const ScopeReach& scope,
                      const PortalReach& reach) {
  ColourImage drawn = panorama;
  const CellGrid cells(panorama, scope, reach);
  for (int y = 0; y < drawn.height; ++y)
    for (int x = 0; x < drawn.width; ++x) {
      const std::optional<std::array<int, 3>> colour = cells.ColourAt(x, y);
      if (!colour) continue;
      std::uint8_t* pixel = drawn.at(x, y);
      for (std::size_t c = 0; c < 3; ++c)
        pixel[c] =
            static_cast<std::uint8_t>((pixel[c] * (100 - kShare) + (*colour)[c] * kShare) / 100);
    }
  return drawn;
}

}  // namespace arthro::simulation
