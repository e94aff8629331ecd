// Projection of a lens as a table, for the many projections of bundle adjustment and sweep.
// A ray (x, y, z) of unit length in the camera frame falls on
//   pixel = centre + k(z) (x, y / aspect),   k(cos θ) = r(θ) / sin θ,
// which is smooth at the axis for every model of simulation/scene/lens.h.
#pragma once

#include <cmath>
#include <vector>

#include "simulation/scene/lens.h"

namespace arthro::authoring {

class LensProfile {
 public:
  LensProfile() = default;
  explicit LensProfile(const Lens& lens);

  double focal_px() const { return focal_px_; }
  double cx() const { return cx_; }
  double cy() const { return cy_; }
  double least_cosine() const { return least_cosine_; }  // smallest cos θ inside the model

  // k and dk/dcos θ. Beyond the model k goes on linearly, so that an optimiser finds its way back.
  double Scale(double cosine, double* slope) const {
    const double at = (cosine - least_cosine_) / step_;
    const int cell = at <= 0 ? 0 : at >= kCells ? kCells - 1 : static_cast<int>(at);
    const double low = table_[static_cast<std::size_t>(cell)];
    const double rise = table_[static_cast<std::size_t>(cell) + 1] - low;
    if (slope) *slope = rise / step_;
    return low + rise * (at - cell);
  }

  // Pixel of a point in the camera frame, which need not have unit length.
  void Project(const double* point, double* pixel) const {
    const double length =
        std::sqrt(point[0] * point[0] + point[1] * point[1] + point[2] * point[2]);
    const double k = Scale(point[2] / length, nullptr) / length;
    pixel[0] = cx_ + k * point[0];
    pixel[1] = cy_ + k * point[1] / aspect_;
  }

  // The same for automatic derivatives; Jet is ceres::Jet.
  template <class Jet>
  void ProjectJet(const Jet* point, Jet* pixel) const {
    using std::sqrt;
    const Jet length = sqrt(point[0] * point[0] + point[1] * point[1] + point[2] * point[2]);
    const Jet cosine = point[2] / length;
    double slope = 0;
    const double value = Scale(cosine.a, &slope);
    Jet k = cosine * slope;
    k.a = value;
    k = k / length;
    pixel[0] = k * point[0] + cx_;
    pixel[1] = k * point[1] * (1 / aspect_) + cy_;
  }

 private:
  static constexpr int kCells = 4096;
  std::vector<double> table_;
  double least_cosine_ = 0, step_ = 1, focal_px_ = 1, cx_ = 0, cy_ = 0, aspect_ = 1;
};

}  // namespace arthro::authoring
