// Area of the surfaces that an instrument touched with more than a safe force, in dabs of 0.5 mm
// about its tip. It is not called damage: no force is known at which cartilage is damaged. m².
#pragma once

#include <array>
#include <cmath>
#include <set>

#include <glm/vec3.hpp>

namespace arthro::simulation {

class MarkedArea {
 public:
  void Add(const glm::dvec3& tip) {
    std::array<long, 3> cell{};
    for (int i = 0; i < 3; ++i)
      cell[static_cast<std::size_t>(i)] = std::lround(std::floor(tip[i] / kDab));
    cells_.insert(cell);
  }
  double area() const { return static_cast<double>(cells_.size()) * kDab * kDab; }

 private:
  static constexpr double kDab = 0.5e-3;  // m
  std::set<std::array<long, 3>> cells_;
};

}  // namespace arthro::simulation
