// A document with a measured relief, made in code: the inside of a sphere of 40 mm about the portal
// with a bump of 10 mm, over 121 x 81 pixels of half a degree. Its left fifth is estimated from
// brightness, a stripe is interpolated, the corner at the top left is unknown.
#pragma once

#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>

#include "authoring/project/document.h"

namespace arthro::test {

inline constexpr int kMeasuredWidth = 121, kMeasuredHeight = 81;
inline constexpr double kMeasuredRadius = 0.04;  // m

inline authoring::Document MeasuredDocument() {
  authoring::Document document;
  ColourImage panorama(kMeasuredWidth, kMeasuredHeight);
  DepthMap depth(kMeasuredWidth, kMeasuredHeight), sigma(kMeasuredWidth, kMeasuredHeight, 2e-4f);
  OriginMap origin(kMeasuredWidth, kMeasuredHeight, ReliefOrigin::kMeasured);
  for (int y = 0; y < kMeasuredHeight; ++y)
    for (int x = 0; x < kMeasuredWidth; ++x) {
      const double u = (x - 80) / 16.0, v = (y - 40) / 16.0;
      depth.at(x, y) = static_cast<float>(0.01 * std::exp(-u * u - v * v));
      std::uint8_t* pixel = panorama.at(x, y);
      const int check = (x / 6 + y / 6) % 2;
      pixel[0] = static_cast<std::uint8_t>(170 + 40 * check);
      pixel[1] = static_cast<std::uint8_t>(120 + 30 * check);
      pixel[2] = static_cast<std::uint8_t>(100 + 30 * check);
      if (x < 24) {
        origin.at(x, y) = ReliefOrigin::kBrightness;
        sigma.at(x, y) = 2e-3f;
      } else if (x < 32) {
        origin.at(x, y) = ReliefOrigin::kInterpolated;
        sigma.at(x, y) = 1e-3f;
      }
      if (x < 10 && y < 10) {
        origin.at(x, y) = ReliefOrigin::kNone;
        depth.at(x, y) = sigma.at(x, y) = std::numeric_limits<float>::quiet_NaN();
      }
    }
  document.panorama = std::make_shared<const ColourImage>(std::move(panorama));
  document.depth = std::make_shared<const DepthMap>(std::move(depth));
  document.depth_sigma = std::make_shared<const DepthMap>(std::move(sigma));
  document.depth_origin = std::make_shared<const OriginMap>(std::move(origin));
  document.is_depth_imported = true;
  Backdrop& backdrop = document.scene.backdrop;
  backdrop.panorama = "panorama.png";
  backdrop.depth = "depth.tiff";
  backdrop.depth_sigma = "depth-sigma.tiff";
  backdrop.depth_origin = "depth-origin.png";
  backdrop.radius = kMeasuredRadius;
  backdrop.projection = {ProjectionType::kEquirectangular, {60, 40}, 1000, 2};
  document.scene.title = "Measured cavity";
  return document;
}

}  // namespace arthro::test
