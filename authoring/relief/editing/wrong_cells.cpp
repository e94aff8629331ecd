#include "authoring/relief/editing/wrong_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

namespace arthro::authoring {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
// Assumed departure of tissue from the membrane per distance from the border: a slope that differs
// by 0.3 from that of the membrane.
constexpr double kSlopeSigma = 0.3;

// A cell that gets a value, and its neighbours that have or get one.
struct OpenCell {
  std::size_t cell = 0;
  int steps = 0;  // from the border
  std::array<std::size_t, 4> neighbours{};
  int count = 0;
};

class Grid {
 public:
  Grid(int width, int height) : width_(width), height_(height) {}
  template <class Use>
  void ForNeighbours(std::size_t cell, Use&& use) const {
    const int x = static_cast<int>(cell % static_cast<std::size_t>(width_)),
              y = static_cast<int>(cell / static_cast<std::size_t>(width_));
    if (x > 0) use(cell - 1);
    if (x + 1 < width_) use(cell + 1);
    if (y > 0) use(cell - static_cast<std::size_t>(width_));
    if (y + 1 < height_) use(cell + static_cast<std::size_t>(width_));
  }

 private:
  int width_, height_;
};

// Gives the open cells first values from the border inwards and counts their steps from it.
std::vector<OpenCell> FillInwards(const Grid& grid, const std::vector<std::uint8_t>& is_open,
                                  std::vector<float>& values) {
  std::vector<OpenCell> cells;
  std::vector<int> steps(values.size(), -1);
  std::vector<std::size_t> front, next;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (is_open[i]) continue;
    if (!std::isnan(values[i])) steps[i] = 0;
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!is_open[i]) continue;
    bool is_at_border = false;
    grid.ForNeighbours(i, [&](std::size_t j) { is_at_border |= steps[j] == 0; });
    if (is_at_border) front.push_back(i);
  }
  for (int step = 1; !front.empty(); ++step) {
    next.clear();
    for (const std::size_t i : front) steps[i] = step;
    for (const std::size_t i : front) {
      double sum = 0;
      int count = 0;
      grid.ForNeighbours(i, [&](std::size_t j) {
        if (steps[j] >= 0 && steps[j] < step) sum += static_cast<double>(values[j]), ++count;
        if (is_open[j] && steps[j] < 0) next.push_back(j);
      });
      values[i] = static_cast<float>(sum / std::max(1, count));
      cells.push_back({i, step, {}, 0});
    }
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    front.swap(next);
  }
  for (OpenCell& cell : cells)
    grid.ForNeighbours(cell.cell, [&](std::size_t j) {
      if (steps[j] >= 0) cell.neighbours[static_cast<std::size_t>(cell.count++)] = j;
    });
  return cells;
}

// Makes every open cell the mean of its neighbours, by successive over-relaxation.
void Relax(const std::vector<OpenCell>& cells, std::vector<float>& values) {
  int depth = 1;
  for (const OpenCell& cell : cells) depth = std::max(depth, cell.steps);
  const double reach = 2.0 * depth + 1;  // cells across the region
  const double over = 2 / (1 + std::sin(std::numbers::pi / (reach + 1)));
  const int most_rounds = 50 + 4 * static_cast<int>(reach);
  constexpr double kSettled = 1e-7;  // m
  for (int round = 0; round < most_rounds; ++round) {
    double change = 0;
    for (const OpenCell& cell : cells) {
      double sum = 0;
      for (int k = 0; k < cell.count; ++k)
        sum += static_cast<double>(values[cell.neighbours[static_cast<std::size_t>(k)]]);
      if (cell.count == 0) continue;
      const double old = static_cast<double>(values[cell.cell]);
      const double step = over * (sum / cell.count - old);
      values[cell.cell] = static_cast<float>(old + step);
      change = std::max(change, std::abs(step));
    }
    if (change < kSettled) break;
  }
}

// Angle between the directions of neighbouring cells.
double CellAngle(const Projection& projection, const glm::dvec2& pixel) {
  return glm::distance(DirectionFromPixel(projection, pixel),
                       DirectionFromPixel(projection, pixel + glm::dvec2(1, 0)));
}

}  // namespace

int MarkAlong(const glm::dvec2& from, const glm::dvec2& to, double radius, CellMarks& marks) {
  const glm::dvec2 along = to - from;
  const double length2 = glm::dot(along, along);
  const auto bound = [](double value, int size) {
    return static_cast<int>(std::clamp(value, -1.0, static_cast<double>(size)));
  };
  const int left = std::max(0, bound(std::floor(std::min(from.x, to.x) - radius), marks.width)),
            top = std::max(0, bound(std::floor(std::min(from.y, to.y) - radius), marks.height)),
            right = bound(std::ceil(std::max(from.x, to.x) + radius), marks.width - 1),
            bottom = bound(std::ceil(std::max(from.y, to.y) + radius), marks.height - 1);
  int marked = 0;
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      const glm::dvec2 p(x, y);
      const double share =
          length2 > 0 ? std::clamp(glm::dot(p - from, along) / length2, 0.0, 1.0) : 0.0;
      if (!(glm::distance(p, from + share * along) <= radius)) continue;
      std::uint8_t& mark =
          marks.is_marked[static_cast<std::size_t>(y) * static_cast<std::size_t>(marks.width) +
                          static_cast<std::size_t>(x)];
      marked += mark == 0;
      mark = 1;
    }
  return marked;
}

ClosedRelief CloseMarked(const ReliefView& view, const CellMarks& marks) {
  ClosedRelief closed{view.relief, view.sigma, view.origin};
  const Grid grid(view.relief.width, view.relief.height);
  std::vector<float>& heights = closed.relief.relief;
  std::vector<std::uint8_t> is_open(heights.size(), 0);
  for (std::size_t i = 0; i < heights.size() && i < marks.is_marked.size(); ++i)
    is_open[i] = marks.is_marked[i] != 0 && !std::isnan(heights[i]);
  const bool has_origin = closed.origin.origin.size() == heights.size();
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (!is_open[i]) continue;
    heights[i] = kUnknown;
    if (has_origin) closed.origin.origin[i] = ReliefOrigin::kNone;
  }
  const std::vector<OpenCell> cells = FillInwards(grid, is_open, heights);
  Relax(cells, heights);
  for (const OpenCell& cell : cells)
    if (has_origin) closed.origin.origin[cell.cell] = ReliefOrigin::kInterpolated;

  if (closed.sigma.relief.size() != heights.size()) return closed;
  std::vector<float>& sigmas = closed.sigma.relief;
  for (std::size_t i = 0; i < sigmas.size(); ++i)
    if (is_open[i]) sigmas[i] = kUnknown;
  const std::vector<OpenCell> uncertain = FillInwards(grid, is_open, sigmas);
  Relax(uncertain, sigmas);
  for (const OpenCell& cell : uncertain) {
    const auto width = static_cast<std::size_t>(view.relief.width);
    const std::size_t column = cell.cell % width, row = cell.cell / width;
    const glm::dvec2 pixel(static_cast<double>(column), static_cast<double>(row));
    const double range = view.radius - static_cast<double>(heights[cell.cell]);
    const double distance = cell.steps * range * CellAngle(view.projection, pixel);
    sigmas[cell.cell] = static_cast<float>(
        std::hypot(static_cast<double>(sigmas[cell.cell]), kSlopeSigma * distance));
  }
  return closed;
}

}  // namespace arthro::authoring
