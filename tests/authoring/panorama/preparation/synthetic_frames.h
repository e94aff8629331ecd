// Frames made in code: a round window over moving texture, under a light fixed to the camera,
// encoded by a camera.
#pragma once

#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace arthro::test {

inline cv::Mat RoundWindow(int size) {
  cv::Mat mask = cv::Mat::zeros(size, size, CV_8U);
  cv::circle(mask, {size / 2, size / 2}, size / 2 - 6, 255, -1);
  return mask;
}

// Texture in about [-1, 1], with detail of `cell` px, at an offset in an unbounded field.
inline double TextureAt(double x, double y, double cell) {
  const double u = x / cell, v = y / cell;
  return 0.4 * std::sin(1.3 * u + 1.7 * std::sin(0.7 * v)) +
         0.35 * std::sin(1.9 * v + 1.1 * std::sin(0.9 * u + 1)) +
         0.25 * std::sin(2.9 * u - 2.3 * v + std::sin(0.31 * u * 1.7));
}

struct FrameLook {
  double dx = 0, dy = 0;  // px, position of the window over the texture
  double texture = 0.15;  // contrast of the albedo
  double falloff = 1.2;   // falloff of the light: exp(-falloff r²), r = 1 at the rim
  double exposure = 0.5;  // linear grey of albedo 1 at the centre, 0 to 1
  double gamma = 2.2;     // exponent of the camera
  double noise = 0;       // standard deviation, grey levels
  int seed = 1;
};

inline cv::Mat MakeFrame(int size, const FrameLook& look) {
  cv::Mat rgb(size, size, CV_8UC3);
  cv::RNG random(static_cast<std::uint64_t>(look.seed) * 7919 + 1);
  const double tint[3] = {1.0, 0.62, 0.52};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double u = (x - size / 2) / (size / 2.0), v = (y - size / 2) / (size / 2.0);
      const double light = look.exposure * std::exp(-look.falloff * (u * u + v * v));
      const double albedo = 1 + look.texture * TextureAt(x + look.dx, y + look.dy, 6.0);
      for (int c = 0; c < 3; ++c) {
        const double grey = 255 * std::pow(light * albedo * tint[c], 1 / look.gamma);
        rgb.at<cv::Vec3b>(y, x)[c] =
            cv::saturate_cast<std::uint8_t>(grey + random.gaussian(1) * look.noise);
      }
    }
  rgb.setTo(cv::Scalar::all(0), RoundWindow(size) == 0);
  return rgb;
}

}  // namespace arthro::test
