#include "tests/support/view/view_cases.h"

#include <cmath>
#include <numbers>

#include "app/view/still_picture.h"
#include "simulation/core/units.h"

namespace arthro::test {

using namespace app;

ColourImage SlowColours(int width, int height) {
  ColourImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = double(x) / width, v = double(y) / height;
      const double wave = 0.5 + 0.25 * std::sin(19 * u + 5 * std::sin(9 * v)) +
                          0.25 * std::sin(23 * v + 4 * std::cos(7 * u));
      std::uint8_t* rgb = image.at(x, y);
      rgb[0] = static_cast<std::uint8_t>(150 + 70 * wave);
      rgb[1] = static_cast<std::uint8_t>(85 + 90 * wave);
      rgb[2] = static_cast<std::uint8_t>(75 + 80 * wave * wave);
    }
  return image;
}

SurfaceMesh Ring(double radius, double thickness, int around, int across) {
  SurfaceMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / across;
      const double r = radius + thickness * std::cos(b);
      mesh.vertices.push_back({r * std::cos(a), r * std::sin(a), 0.7 * thickness * std::sin(b)});
    }
  const auto at = [&](int i, int j) { return (i % around) * across + j % across; };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

SurfaceMesh Moved(SurfaceMesh mesh, const Pose& target_from_mesh) {
  for (glm::dvec3& vertex : mesh.vertices) vertex = target_from_mesh * vertex;
  return mesh;
}

InstrumentView ProbeInFront() { return {{0.03, 0, 0}, {0.005, 0.001, 0.024}, 3.4}; }

LoadedScene WavyJoint(int width) {
  const int height = width / 2;
  LoadedScene loaded;
  Backdrop& backdrop = loaded.scene.backdrop;
  backdrop.radius = 0.05;
  backdrop.projection.centre_px = {(width - 1) / 2.0, (height - 1) / 2.0};
  backdrop.projection.focal_px = 1500.0 * width / 4096;
  DepthMap depth(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = double(x) / width, v = double(y) / height;
      const double du = u - 0.55, dv = 0.5 * (v - 0.6);
      depth.at(x, y) = static_cast<float>(0.004 + 0.008 * std::exp(-60 * (du * du + dv * dv)) +
                                          0.003 * std::sin(25 * u) * std::sin(18 * v) +
                                          (u + v / 6 < 0.56 ? 0.004 : 0.0));
    }
  loaded.panorama = Share(SlowColours(width, height));
  loaded.depth = Share(std::move(depth));
  return loaded;
}

Picture ViewOfWavyJoint() {
  return PictureFromPose({-0.1, 0.05, 0.2, 0.008}, RadiansFromDegrees(30), RadiansFromDegrees(90));
}

}  // namespace arthro::test
