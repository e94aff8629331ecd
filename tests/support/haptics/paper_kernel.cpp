#include "tests/support/haptics/paper_kernel.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace arthro::test {

using namespace simulation;

FieldQuery PaperQuery(const Backdrop& backdrop, const DepthMap& depth,
                      const glm::dvec3& x) noexcept {
  FieldQuery query;
  const double length = glm::length(x);
  if (!(length > 0.0)) return query;
  const auto pixel = PixelFromDirection(backdrop.projection, x);
  if (!pixel) return query;
  const double u = std::floor(pixel->x + 0.5), v = std::floor(pixel->y + 0.5);
  if (!(u >= 1 && v >= 1 && u <= depth.width - 2 && v <= depth.height - 2)) return query;
  const int px = static_cast<int>(u), py = static_cast<int>(v);
  double h[3][3], sum = 0;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      sum += h[j][i] = static_cast<double>(depth.at(px + i - 1, py + j - 1));
  if (!std::isfinite(sum)) return query;
  // Sobel's weights: 1 2 1 across, a central difference along.
  double hu = 0, hv = 0;
  constexpr double kAcross[3] = {0.125, 0.25, 0.125};
  for (int k = 0; k < 3; ++k) {
    hu += kAcross[k] * (h[k][2] - h[k][0]);
    hv += kAcross[k] * (h[2][k] - h[0][k]);
  }
  const glm::dmat2x3 gradients = PixelGradients(backdrop.projection, x);
  const glm::dvec3 gradient = x / -length - hu * gradients[0] - hv * gradients[1];
  const double slope = glm::length(gradient);
  query.clearance = (backdrop.radius - h[1][1] - length) / slope;
  query.normal = gradient / slope;
  query.weight = 1.0;
  query.px_per_m = glm::length(gradients[0]);
  return query;
}

}  // namespace arthro::test
