#include "authoring/phantom/clip/plane_texture.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "authoring/phantom/clip/plane_noise.h"

namespace arthro::authoring {
namespace {

using Colour = cv::Vec3f;

constexpr double kUsualRadius = 300;  // px: window radius for the sizes below

float Soft(float distance) {
  return 1.0f / (1.0f + std::exp(std::clamp(distance / 0.004f, -40.0f, 40.0f)));
}

// Tissues of the scene at a quarter of the size: colours, and the shares of synovium, meniscus and
// ligament in a pixel.
struct Regions {
  cv::Mat colour;                        // CV_32FC3
  cv::Mat synovium, meniscus, ligament;  // CV_32F
};

Regions RegionsOf(cv::Size2d world, const cv::Rect& region, double scale, double contrast,
                  Random& random) {
  const cv::Size size((region.width + 3) / 4, (region.height + 3) / 4);
  const cv::Mat bend_x = PlaneNoise(size, {700 * scale / 4, 3}, random),
                bend_y = PlaneNoise(size, {700 * scale / 4, 3}, random);
  const float ox = static_cast<float>(random.Uniform(-0.12, 0.12)),
              oy = static_cast<float>(random.Uniform(-0.12, 0.12));
  const float bend = static_cast<float>(120 * scale), w = static_cast<float>(world.width),
              h = static_cast<float>(world.height);
  Regions r;
  r.colour.create(size, CV_32FC3);
  for (cv::Mat* m : {&r.synovium, &r.meniscus, &r.ligament}) m->create(size, CV_32F);
  const float border = static_cast<float>(0.25 * (0.4 + 0.6 * std::min(contrast, 1.0)));
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const float u = (4.0f * static_cast<float>(x) + static_cast<float>(region.x) +
                       bend * bend_x.at<float>(y, x)) /
                      w;
      const float v = (4.0f * static_cast<float>(y) + static_cast<float>(region.y) +
                       bend * bend_y.at<float>(y, x)) /
                      h;
      const float femur = Soft(std::hypot((u - 0.5f - ox) / 0.55f, (v - 0.05f - oy) / 0.45f) - 1);
      const float tibia = Soft(std::hypot((u - 0.45f + ox) / 0.6f, (v - 1 - oy) / 0.38f) - 1);
      const float ring = std::hypot((u - 0.5f) / 0.62f, (v - 0.62f - oy) / 0.3f);
      const float meniscus = Soft(std::abs(ring - 0.72f) - 0.10f) * (1 - femur);
      const float ligament =
          Soft(std::abs((u - 0.78f + ox) - 0.25f * (v - 0.5f)) - 0.045f) * (1 - femur);
      Colour colour(0.70f, 0.36f, 0.31f);
      float synovium = 1, shade = 1;
      const auto lay = [&](float share, const Colour& c) {
        colour = colour * (1 - share) + c * share;
        synovium *= 1 - share;
        shade *= 1 - border * 4 * share * (1 - share);  // contact shading along borders
      };
      lay(tibia, {0.84f, 0.77f, 0.72f});
      lay(meniscus, {0.90f, 0.82f, 0.64f});
      lay(ligament, {0.88f, 0.74f, 0.62f});
      lay(femur, {0.87f, 0.81f, 0.77f});
      r.colour.at<Colour>(y, x) = colour * shade;
      r.synovium.at<float>(y, x) = synovium;
      r.meniscus.at<float>(y, x) = meniscus;
      r.ligament.at<float>(y, x) = ligament;
    }
  return r;
}

// Fibres across the picture, rotated.
cv::Mat Fibres(cv::Size size, double scale, Random& random) {
  const double angle = random.Uniform(35, 80);
  const cv::Mat straight = PlaneNoise(size, {10 * scale, 3, 0.55, 14}, random);
  const cv::Point2f middle(static_cast<float>(size.width) / 2, static_cast<float>(size.height) / 2);
  cv::Mat turned;
  cv::warpAffine(straight, turned, cv::getRotationMatrix2D(middle, angle, 1.3), size,
                 cv::INTER_LINEAR, cv::BORDER_REFLECT);
  return turned;
}

void AddGround(PlaneTexture& texture, const ClipOptions& options, double scale, Random& random) {
  const cv::Size size = texture.albedo.size(), half((size.width + 1) / 2, (size.height + 1) / 2);
  // Heights in half-size pixels, so that slopes are px per px.
  cv::Mat bump = PlaneNoise(half, {44 * scale / 2, 3}, random) * (3.2 * scale / 2) +
                 PlaneNoise(half, {std::max(4.0, 10 * scale) / 2, 2}, random) * (0.22 * scale / 2);
  cv::Mat gx, gy;
  cv::Sobel(bump, gx, CV_32F, 1, 0, 3, 1 / 8.0);
  cv::Sobel(bump, gy, CV_32F, 0, 1, 3, 1 / 8.0);
  const cv::Mat both[] = {gx, gy};
  cv::merge(both, 2, texture.slope);
  if (options.relief > 0) {
    const cv::Size quarter((size.width + 3) / 4, (size.height + 3) / 4);
    texture.height = PlaneNoise(quarter, {420 * scale / 4, 2}, random);
  }
}

// Repeats the first patch with a period of `tile` px, blended at its seams.
void Repeat(cv::Mat& albedo, int tile, int fade) {
  if (albedo.cols < tile + fade || albedo.rows < tile + fade) return;
  cv::Mat patch;
  albedo(cv::Rect(0, 0, tile + fade, tile + fade)).convertTo(patch, CV_32F);
  const auto mix = [&](int to, bool along_x) {
    for (int i = 0; i < fade; ++i) {
      const double share = (i + 0.5) / fade;
      cv::Mat first = along_x ? patch.col(i) : patch.row(i);
      const cv::Mat again = along_x ? patch.col(to + i) : patch.row(to + i);
      cv::addWeighted(first, share, again, 1 - share, 0, first);
    }
  };
  mix(tile, true);
  mix(tile, false);
  cv::Mat small;
  patch(cv::Rect(0, 0, tile, tile)).convertTo(small, CV_16U);
  cv::Mat all;
  cv::repeat(small, (albedo.rows + tile - 1) / tile, (albedo.cols + tile - 1) / tile, all);
  all(cv::Rect(0, 0, albedo.cols, albedo.rows)).copyTo(albedo);
}

}  // namespace

PlaneTexture KneeTexture(const ClipOptions& options, cv::Size2d world, const cv::Rect& region,
                         double radius) {
  const double scale = radius / kUsualRadius;
  const cv::Size size = region.size();
  Random random(static_cast<std::uint64_t>(options.seed) * 7919 + 11);
  const Regions regions = RegionsOf(world, region, scale, options.contrast, random);
  const cv::Mat slow = PlaneNoise(size, {260 * scale, 3}, random),
                middle = PlaneNoise(size, {60 * scale, 4}, random),
                grain = PlaneNoise(size, {14 * scale, 3}, random),
                fibres = Fibres(size, scale, random);
  const double area = size.area() / (12e6 * scale * scale);
  const auto count = [&](int whole) {
    return std::max(3, static_cast<int>(std::lround(whole * area)));
  };
  const cv::Mat thick = VesselsOnPlane(size, count(130), 6, scale, random),
                thin = VesselsOnPlane(size, count(220), 2, scale, random);

  const float k = static_cast<float>(options.contrast), kv = static_cast<float>(options.vessels);
  PlaneTexture texture;
  texture.albedo.create(size, CV_16UC3);
  cv::Mat colour, synovium, meniscus, ligament;
  const auto enlarge = [&](const cv::Mat& small, cv::Mat& large) {
    cv::resize(small, large, size, 0, 0, cv::INTER_LINEAR);
  };
  enlarge(regions.colour, colour);
  enlarge(regions.synovium, synovium);
  enlarge(regions.meniscus, meniscus);
  enlarge(regions.ligament, ligament);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const float mid = middle.at<float>(y, x), fine = grain.at<float>(y, x),
                  syn = synovium.at<float>(y, x);
      const float fibre = fibres.at<float>(y, x) *
                          (0.03f * meniscus.at<float>(y, x) + 0.04f * ligament.at<float>(y, x));
      const float light = 0.05f * slow.at<float>(y, x) + 0.030f * mid + 0.016f * fine + fibre +
                          syn * (0.05f * mid + 0.03f * fine);
      Colour c = colour.at<Colour>(y, x) * (1 + k * light);
      const float tint = k * 0.02f * mid;
      c += Colour(tint, -0.2f * tint, -0.6f * tint);
      const float vessel = 0.35f * kv * thick.at<float>(y, x) * (0.9f * syn + 0.12f);
      c = c * (1 - vessel) + vessel * Colour(0.50f, 0.10f, 0.10f);
      const float capillary = 0.10f * kv * k * thin.at<float>(y, x);
      c = Colour(c[0] * (1 - 0.3f * capillary), c[1] * (1 - capillary), c[2] * (1 - capillary));
      for (int i = 0; i < 3; ++i)
        texture.albedo.at<cv::Vec3w>(y, x)[i] =
            static_cast<std::uint16_t>(65535 * std::clamp(c[i], 0.02f, 1.0f) + 0.5f);
    }
  if (options.repeated)
    Repeat(texture.albedo, static_cast<int>(std::lround(3 * radius)),
           std::max(4, static_cast<int>(std::lround(0.3 * radius))));
  AddGround(texture, options, scale, random);
  return texture;
}

PlaneTexture PictureTexture(const cv::Mat& picture, const ClipOptions& options, double radius) {
  Random random(static_cast<std::uint64_t>(options.seed) * 7919 + 13);
  cv::Mat code(1, 256, CV_32F);
  for (int i = 0; i < 256; ++i)
    code.at<float>(i) = static_cast<float>(std::pow(i / 255.0, options.gamma));
  cv::Mat colour;
  cv::LUT(picture, code, colour);
  PlaneTexture texture;
  colour.convertTo(texture.albedo, CV_16U, 65535);
  AddGround(texture, options, radius / kUsualRadius, random);
  return texture;
}

}  // namespace arthro::authoring
