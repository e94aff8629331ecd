#include "authoring/lens/target/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <iterator>
#include <optional>
#include <set>

namespace arthro::authoring {
namespace {

using Place = std::pair<int, int>;

constexpr std::array<Place, 4> kSides = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
constexpr double kGuessTolerance =
    0.28;                   // share of a step, tolerance about the guess of a neighbour
constexpr int kSeeds = 24;  // most that are tried

Place Plus(const Place& a, const Place& b, int times = 1) {
  return {a.first + times * b.first, a.second + times * b.second};
}

// Candidates in square cells, so that a look-up reads few of them.
class PointField {
 public:
  PointField(const std::vector<cv::Point2d>& points, cv::Size picture)
      : points_(points), columns_(picture.width / kCell + 1), rows_(picture.height / kCell + 1) {
    cells_.resize(static_cast<std::size_t>(columns_) * rows_);
    for (int n = 0; n < static_cast<int>(points.size()); ++n)
      cells_[CellOf(points[n])].push_back(n);
  }

  // Returns the nearest candidate within `radius`, or -1.
  int Nearest(const cv::Point2d& at, double radius) const {
    int best = -1;
    double nearest = radius;
    Visit(at, radius, [&](int n, double distance) {
      if (distance <= nearest) {
        nearest = distance;
        best = n;
      }
    });
    return best;
  }

  // Returns up to 12 nearest neighbours, nearest first.
  std::vector<int> Around(int n) const {
    constexpr std::size_t kWanted = 12;
    std::vector<std::pair<double, int>> found;
    for (double radius = kCell; radius < 600 && found.size() < kWanted; radius *= 2) {
      found.clear();
      Visit(points_[n], radius, [&](int other, double distance) {
        if (other != n) found.push_back({distance, other});
      });
    }
    std::sort(found.begin(), found.end());
    std::vector<int> nearest;
    for (std::size_t k = 0; k < std::min(kWanted, found.size()); ++k)
      nearest.push_back(found[k].second);
    return nearest;
  }

 private:
  static constexpr int kCell = 16;  // px

  int Column(double x) const { return std::clamp(static_cast<int>(x) / kCell, 0, columns_ - 1); }
  int Row(double y) const { return std::clamp(static_cast<int>(y) / kCell, 0, rows_ - 1); }
  int CellOf(const cv::Point2d& p) const { return Row(p.y) * columns_ + Column(p.x); }

  template <class F>
  void Visit(const cv::Point2d& at, double radius, F&& visit) const {
    for (int row = Row(at.y - radius); row <= Row(at.y + radius); ++row)
      for (int column = Column(at.x - radius); column <= Column(at.x + radius); ++column)
        for (const int n : cells_[static_cast<std::size_t>(row) * columns_ + column])
          if (const double distance = cv::norm(points_[n] - at); distance <= radius)
            visit(n, distance);
  }

  const std::vector<cv::Point2d>& points_;
  int columns_, rows_;
  std::vector<std::vector<int>> cells_;
};

struct Seed {
  int centre;
  std::array<int, 4> sides;  // in the order of kSides
  double unevenness;
};

// Finds two steps from a candidate whose opposites exist as well: the shortest such pair.
std::optional<Seed> SeedAt(const std::vector<cv::Point2d>& points, const PointField& field, int n) {
  const std::vector<int> around = field.Around(n);
  std::optional<Seed> best;
  double best_cost = 0;
  const auto Opposite = [&](int side, double& error) {
    const cv::Point2d step = points[side] - points[n];
    const double length = cv::norm(step);
    const int other = field.Nearest(points[n] - step, 0.25 * length);
    error = other < 0 ? 0 : cv::norm(points[n] - step - points[other]) / length;
    return other;
  };
  for (const int a : around)
    for (const int b : around) {
      const cv::Point2d u = points[a] - points[n], v = points[b] - points[n];
      const double cross = u.cross(v), lengths = cv::norm(u) * cv::norm(v);
      if (!(cross > 0.6 * lengths)) continue;  // clockwise, 37 to 143 degrees apart
      const double ratio = cv::norm(u) / cv::norm(v);
      if (ratio < 0.4 || ratio > 2.5) continue;
      double error_a = 0, error_b = 0;
      const int c = Opposite(a, error_a), d = Opposite(b, error_b);
      if (c < 0 || d < 0) continue;
      const double cost = (cv::norm(u) + cv::norm(v)) * (1 + error_a + error_b);
      if (best && cost >= best_cost) continue;
      best_cost = cost;
      best = Seed{n, {a, b, c, d}, error_a + error_b + 0.2 * std::abs(std::log(ratio))};
    }
  return best;
}

class Grower {
 public:
  Grower(const std::vector<cv::Point2d>& points, const PointField& field, double smallest_step)
      : points_(points), field_(field), smallest_step_(smallest_step) {}

  Lattice Grow(const Seed& seed) {
    Put({0, 0}, seed.centre);
    for (int k = 0; k < 4; ++k) Put(kSides[k], seed.sides[k]);
    // Steps over a missing point are less certain, so they wait until no plain step is left.
    while (!queue_.empty() || !ends_.empty()) {
      std::deque<Place>& next = queue_.empty() ? ends_ : queue_;
      const int times = queue_.empty() ? 2 : 1;
      const Place place = next.front();
      next.pop_front();
      for (const Place& side : kSides) Step(place, side, times);
      if (times == 1) ends_.push_back(place);
    }
    return lattice_;
  }

  const std::set<int>& taken() const { return taken_; }

 private:
  void Put(const Place& place, int n) {
    if (lattice_.contains(place) || !taken_.insert(n).second) return;
    lattice_[place] = points_[n];
    queue_.push_back(place);
  }

  const cv::Point2d* Find(const Place& place) const {
    const auto found = lattice_.find(place);
    return found == lattice_.end() ? nullptr : &found->second;
  }

  // Guesses one step from `place` to `side`: continues the last step with its curvature, or copies
  // a neighbour's step.
  std::optional<cv::Point2d> Guess(const Place& place, const Place& side) const {
    const cv::Point2d& here = lattice_.at(place);
    if (const auto* back = Find(Plus(place, side, -1))) {
      const cv::Point2d step = here - *back;
      const auto* further = Find(Plus(place, side, -2));
      return further ? step + 0.7 * (step - (*back - *further)) : step;
    }
    const Place across{side.second, side.first};
    for (const int turn : {1, -1})
      if (const auto* beside = Find(Plus(place, across, turn)))
        if (const auto* ahead = Find(Plus(Plus(place, across, turn), side)))
          return *ahead - *beside;
    return std::nullopt;
  }

  void Step(const Place& place, const Place& side, int times) {
    const Place target = Plus(place, side, times);
    if (lattice_.contains(Plus(place, side)) || lattice_.contains(target)) return;
    const auto step = Guess(place, side);
    if (!step) return;
    const cv::Point2d& here = lattice_.at(place);
    const double length = cv::norm(*step);
    if (length < smallest_step_) return;
    // A point is missing only when no candidate lies nearby; otherwise the guess was wrong.
    if (times > 1 && field_.Nearest(here + *step, 0.7 * length) >= 0) return;
    const int n = field_.Nearest(here + times * *step, kGuessTolerance * length);
    if (n >= 0 && !taken_.contains(n) && AgreesAllRound(target, points_[n])) Put(target, n);
  }

  // Checks that every existing neighbour predicts this point. Two parts of a lattice that meet with
  // different counts would tear here.
  bool AgreesAllRound(const Place& place, const cv::Point2d& point) const {
    constexpr double kTear = 0.45;  // share of a step
    for (const Place& side : kSides) {
      const auto* beside = Find(Plus(place, side, -1));
      if (!beside) continue;
      const auto step = Guess(Plus(place, side, -1), side);
      if (step && cv::norm(*beside + *step - point) > kTear * cv::norm(*step)) return false;
    }
    return true;
  }

  const std::vector<cv::Point2d>& points_;
  const PointField& field_;
  double smallest_step_;
  Lattice lattice_;
  std::set<int> taken_;
  std::deque<Place> queue_, ends_;
};

}  // namespace

double StepAt(const Lattice& lattice, const Place& place) {
  const cv::Point2d& here = lattice.at(place);
  double step = 0;
  for (const Place& side : kSides) {
    const auto other = lattice.find(Plus(place, side));
    if (other == lattice.end()) continue;
    const double length = cv::norm(other->second - here);
    if (step == 0 || length < step) step = length;
  }
  return step;
}

void PruneLattice(Lattice& lattice, double tolerance) {
  for (bool changed = true; changed;) {
    changed = false;
    for (auto at = lattice.begin(); at != lattice.end();) {
      int neighbours = 0;
      for (const Place& side : kSides)
        neighbours += static_cast<int>(lattice.count(Plus(at->first, side)));
      changed |= neighbours < 2;
      at = neighbours < 2 ? lattice.erase(at) : std::next(at);
    }
    // Removes the worst point alone, since it distorts the residuals of its neighbours.
    auto worst = lattice.end();
    double most = tolerance;
    for (auto at = lattice.begin(); at != lattice.end(); ++at)
      for (int axis = 0; axis < 2; ++axis) {
        const auto a = lattice.find(Plus(at->first, kSides[axis]));
        const auto b = lattice.find(Plus(at->first, kSides[axis], -1));
        if (a == lattice.end() || b == lattice.end()) continue;
        const double off = cv::norm(at->second - 0.5 * (a->second + b->second));
        const double share = off / (0.5 * cv::norm(a->second - b->second));
        if (share <= most) continue;
        most = share;
        worst = at;
      }
    if (worst == lattice.end()) continue;
    lattice.erase(worst);
    changed = true;
  }
}

Lattice GrowLattice(const std::vector<cv::Point2d>& candidates, cv::Size picture,
                    double smallest_step, const std::function<bool(const Lattice&)>& fits) {
  constexpr std::size_t kFewest = 9;
  const PointField field(candidates, picture);
  std::vector<Seed> seeds;
  for (int n = 0; n < static_cast<int>(candidates.size()); ++n)
    if (const auto seed = SeedAt(candidates, field, n)) seeds.push_back(*seed);
  std::stable_sort(seeds.begin(), seeds.end(),
                   [](const Seed& a, const Seed& b) { return a.unevenness < b.unevenness; });
  std::vector<char> used(candidates.size(), 0);
  Lattice largest;
  int tried = 0;
  for (const Seed& seed : seeds) {
    if (used[seed.centre] || tried == kSeeds) continue;
    ++tried;
    Grower grower(candidates, field, smallest_step);
    Lattice lattice = grower.Grow(seed);
    PruneLattice(lattice, 0.25);
    if (lattice.size() < kFewest || !fits(lattice)) continue;
    for (const int n : grower.taken()) used[n] = 1;  // no later seed begins there
    if (lattice.size() > largest.size()) largest = std::move(lattice);
  }
  return largest;
}

}  // namespace arthro::authoring
