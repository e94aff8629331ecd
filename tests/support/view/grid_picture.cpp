#include "tests/support/view/grid_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>

#include "tests/support/view/reference_tracer.h"

namespace arthro::test {
namespace {

// Signed distance to the nearest grid line, px of the panorama.
double FromLine(double u, double spacing) { return u - spacing * std::round(u / spacing); }

}  // namespace

int GridPanorama::CellLevel(const glm::dvec2& pixel) const {
  // 7 i + 13 j mod 31 differs between all cells of a 5 x 5 neighbourhood.
  const long cell = 7 * std::lround(std::floor(pixel.x / spacing)) +
                    13 * std::lround(std::floor(pixel.y / spacing));
  return static_cast<int>(8 * (((cell % 31) + 31) % 31));
}

ColourImage GridPanorama::Draw() const {
  ColourImage image(width, height);
  const auto brightness = [&](double position) {
    const double d = FromLine(position, spacing) / line_sigma;
    return static_cast<std::uint8_t>(std::lround(255.0 * std::exp(-0.5 * d * d)));
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::uint8_t* rgb = image.at(x, y);
      rgb[0] = brightness(x);
      rgb[1] = brightness(y);
      rgb[2] = static_cast<std::uint8_t>(CellLevel({x, y}));
    }
  return image;
}

std::vector<LineCrossing> FindLineCrossings(const ColourImage& picture, int threshold) {
  std::vector<LineCrossing> crossings;
  for (int channel : {0, 1})
    for (bool along_row : {true, false}) {
      const int scans = along_row ? picture.height : picture.width;
      const int length = along_row ? picture.width : picture.height;
      const auto value = [&](int scan, int i) {
        return static_cast<int>((along_row ? picture.at(i, scan) : picture.at(scan, i))[channel]);
      };
      for (int scan = 0; scan < scans; ++scan)
        for (int i = 1; i + 1 < length; ++i) {
          const int before = value(scan, i - 1), here = value(scan, i), after = value(scan, i + 1);
          // A flat top of two equal pixels counts once, at its first.
          if (here < threshold || here <= before || here < after || before == 0 || after == 0)
            continue;
          const double a = std::log(before), b = std::log(here), c = std::log(after);
          const double position = i + 0.5 * (a - c) / (a - 2.0 * b + c);
          crossings.push_back({along_row ? glm::dvec2(position, scan) : glm::dvec2(scan, position),
                               channel, along_row});
        }
    }
  return crossings;
}

GridAgreement CompareWithGrid(const ColourImage& picture, const GridPanorama& grid,
                              const Backdrop& backdrop, const simulation::ScopeView& view,
                              double field_of_view, double rim_px, const Lens* lens) {
  const int size = picture.width;
  const glm::dvec2 centre(0.5 * (size - 1));
  const auto panorama_at = [&](const glm::dvec2& pixel) {
    return PanoramaPixelAt(backdrop, view, field_of_view, size, pixel, lens);
  };
  const auto is_inside = [&](const glm::dvec2& pixel) {
    return glm::length(pixel - centre) < 0.5 * size - rim_px;
  };
  // A line is measurable where the panorama goes on beyond its profile.
  const auto is_imaged = [&](const glm::dvec2& u) {
    const double margin = 4.0 * grid.line_sigma;
    return u.x > margin && u.y > margin && u.x < grid.width - margin && u.y < grid.height - margin;
  };

  GridAgreement agreement;
  double sum2 = 0.0;
  for (const LineCrossing& crossing : FindLineCrossings(picture)) {
    if (!is_inside(crossing.pixel)) continue;
    constexpr double kStep = 0.25;  // px, for the slope of the panorama coordinate
    const auto here = panorama_at(crossing.pixel);
    const auto left = panorama_at(crossing.pixel - glm::dvec2(kStep, 0));
    const auto right = panorama_at(crossing.pixel + glm::dvec2(kStep, 0));
    const auto above = panorama_at(crossing.pixel - glm::dvec2(0, kStep));
    const auto below = panorama_at(crossing.pixel + glm::dvec2(0, kStep));
    if (!here || !left || !right || !above || !below || !is_imaged(*here)) continue;
    const int c = crossing.channel;
    const glm::dvec2 slope =
        glm::dvec2((*right)[c] - (*left)[c], (*below)[c] - (*above)[c]) / (2.0 * kStep);
    const double along = std::abs(crossing.along_row ? slope.x : slope.y);
    if (along < std::abs(crossing.along_row ? slope.y : slope.x)) continue;
    // A profile narrower than a pixel of the picture cannot be measured to sub-pixel.
    if (along > grid.line_sigma) continue;
    const double error = std::abs(FromLine((*here)[c], grid.spacing)) / glm::length(slope);
    ++agreement.crossings;
    sum2 += error * error;
    if (error > agreement.max_px) {
      agreement.max_px = error;
      agreement.worst = crossing.pixel;
    }
  }
  if (agreement.crossings > 0) agreement.rms_px = std::sqrt(sum2 / agreement.crossings);

  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      if (!is_inside({x, y})) continue;
      const auto u = panorama_at({x, y});
      if (!u || !is_imaged(*u)) continue;
      const double margin = 0.25 * grid.spacing;
      if (std::abs(FromLine(u->x, grid.spacing)) < margin ||
          std::abs(FromLine(u->y, grid.spacing)) < margin)
        continue;
      ++agreement.cells;
      agreement.wrong_cells += std::abs(picture.at(x, y)[2] - grid.CellLevel(*u)) > 3;
    }
  return agreement;
}

}  // namespace arthro::test
