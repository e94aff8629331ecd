// A small joint made in code for tests of the view: a panorama like tissue, a relief with a bulge,
// a ring in front of it; and a fixture that skips with a message when nothing can draw.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "app/view/still_picture.h"
#include "simulation/core/error.h"
#include "simulation/scene/files/scene_io.h"
#include "tests/support/view/view_cases.h"

namespace arthro::test {

inline SurfaceMesh Ellipsoid(const glm::dvec3& radii, int around = 48, int along = 24) {
  SurfaceMesh mesh;
  mesh.vertices.push_back({0, 0, radii.z});
  for (int j = 1; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const double a = 2 * std::numbers::pi * i / around, b = std::numbers::pi * j / along;
      mesh.vertices.push_back(
          radii * glm::dvec3(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b)));
    }
  mesh.vertices.push_back({0, 0, -radii.z});
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [&](int j, int i) { return 1 + (j - 1) * around + i % around; };
  for (int i = 0; i < around; ++i) {
    mesh.triangles.push_back({0, at(1, i), at(1, i + 1)});
    mesh.triangles.push_back({last, at(along - 1, i + 1), at(along - 1, i)});
    for (int j = 1; j + 1 < along; ++j) {
      mesh.triangles.push_back({at(j, i), at(j + 1, i), at(j + 1, i + 1)});
      mesh.triangles.push_back({at(j, i), at(j + 1, i + 1), at(j, i + 1)});
    }
  }
  return mesh;
}

inline LoadedScene MakeViewScene(int width = 1024, int height = 768) {
  LoadedScene loaded;
  Backdrop& backdrop = loaded.scene.backdrop;
  loaded.scene.title = "a joint for tests";
  backdrop.panorama = "panorama.png";
  backdrop.depth = "depth.tiff";
  backdrop.radius = 0.05;
  backdrop.medium = Medium::kGas;  // in saline tissue has no highlights
  backdrop.projection.centre_px = {(width - 1) / 2.0, (height - 1) / 2.0};
  backdrop.projection.focal_px = 0.42 * width;
  DepthMap depth(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = double(x) / width, v = double(y) / height;
      const double du = u - 0.55, dv = v - 0.6;
      depth.at(x, y) = static_cast<float>(0.004 + 0.008 * std::exp(-30 * (du * du + dv * dv)));
    }
  Tissue ring;
  ring.name = "ring";
  ring.surface = "ring.ply";
  ring.pose.position = {0.002, 0.004, 0.034};
  ring.pose.quaternion = glm::dquat(std::cos(0.5), std::sin(0.5), 0, 0);
  loaded.scene.tissues = {ring};
  loaded.panorama = Share(SlowColours(width, height));
  loaded.depth = Share(std::move(depth));
  loaded.surfaces = {Share(Ring(0.007, 0.0024))};
  return loaded;
}

class ViewTest : public ::testing::Test {
 protected:
  void SetUp() override {
    try {
      context_ = std::make_unique<app::OffscreenContext>();
    } catch (const Error& error) {
      GTEST_SKIP() << "NOT TESTED, NOTHING WAS DRAWN: " << error.what();
    }
    view_ = std::make_unique<app::ArthroscopicView>();
  }
  void TearDown() override {
    view_.reset();
    context_.reset();
  }

  std::unique_ptr<app::OffscreenContext> context_;
  std::unique_ptr<app::ArthroscopicView> view_;
};

}  // namespace arthro::test
