#include "authoring/phantom/clip/plane_light.h"

namespace arthro::authoring {
namespace {

constexpr float kGlintPower = 900;  // exponent; a wet surface reflects within about 3°

// Bilinear interpolation of a field, extended beyond its border.
template <class T>
T Linear(const cv::Mat& field, float x, float y) {
  x = std::clamp(x, 0.0f, static_cast<float>(field.cols - 1));
  y = std::clamp(y, 0.0f, static_cast<float>(field.rows - 1));
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, field.cols - 1), y1 = std::min(y0 + 1, field.rows - 1);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const T *above = field.ptr<T>(y0), *below = field.ptr<T>(y1);
  return (above[x0] * (1 - fx) + above[x1] * fx) * (1 - fy) +
         (below[x0] * (1 - fx) + below[x1] * fx) * fy;
}

// Catmull-Rom weights of the four pixels around.
inline void Weights(float f, float w[4]) {
  const float f2 = f * f, f3 = f2 * f;
  w[0] = 0.5f * (-f3 + 2 * f2 - f);
  w[1] = 0.5f * (3 * f3 - 5 * f2 + 2);
  w[2] = 0.5f * (-3 * f3 + 4 * f2 + f);
  w[3] = 0.5f * (f3 - f2);
}

}  // namespace

PlaneLight::PlaneLight(const PlaneTexture& texture, const ClipOptions& options, double radius,
                       double focal)
    : texture_(texture),
      relief_(static_cast<float>(options.relief * radius)),
      per_focal_(static_cast<float>(1 / focal)),
      falloff_(static_cast<float>(options.falloff)),
      vignette_(static_cast<float>(options.vignette)),
      bumps_(static_cast<float>(options.bumps)),
      highlights_(static_cast<float>(2.2 * options.highlights)),
      plain_falloff_(options.falloff == 1.0) {}

PlaneLight::View PlaneLight::ViewOf(const ScopePose& pose) {
  return {cv::Matx33f(pose.plane_from_camera), static_cast<float>(pose.at.x),
          static_cast<float>(pose.at.y), static_cast<float>(pose.distance)};
}

cv::Vec3f PlaneLight::AlbedoAt(float x, float y, bool smooth) const {
  const cv::Mat& albedo = texture_.albedo;
  x = std::clamp(x, 1.0f, static_cast<float>(albedo.cols - 3));
  y = std::clamp(y, 1.0f, static_cast<float>(albedo.rows - 3));
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  float sum[3] = {0, 0, 0};
  if (smooth) {
    float wx[4], wy[4];
    Weights(fx, wx);
    Weights(fy, wy);
    for (int j = 0; j < 4; ++j) {
      const std::uint16_t* p = albedo.ptr<std::uint16_t>(y0 - 1 + j) + 3 * (x0 - 1);
      for (int c = 0; c < 3; ++c)
        sum[c] += wy[j] * (wx[0] * p[c] + wx[1] * p[c + 3] + wx[2] * p[c + 6] + wx[3] * p[c + 9]);
    }
  } else {
    for (int j = 0; j < 2; ++j) {
      const std::uint16_t* p = albedo.ptr<std::uint16_t>(y0 + j) + 3 * x0;
      const float w = j ? fy : 1 - fy;
      for (int c = 0; c < 3; ++c) sum[c] += w * ((1 - fx) * p[c] + fx * p[c + 3]);
    }
  }
  return cv::Vec3f(sum[0], sum[1], sum[2]) * (1 / 65535.0f);
}

cv::Vec3f PlaneLight::Along(const View& view, const cv::Vec3f& ray, float off_axis,
                            bool smooth) const {
  const cv::Matx33f& r = view.plane_from_camera;
  const float dx = r(0, 0) * ray[0] + r(0, 1) * ray[1] + r(0, 2) * ray[2];
  const float dy = r(1, 0) * ray[0] + r(1, 1) * ray[1] + r(1, 2) * ray[2];
  const float dz = std::max(0.05f, r(2, 0) * ray[0] + r(2, 1) * ray[1] + r(2, 2) * ray[2]);
  float t = view.distance / dz, x = view.x + t * dx, y = view.y + t * dy;
  float ground_x = 0, ground_y = 0;
  if (relief_ > 0) {
    const auto height = [&](float px, float py) {
      return Linear<float>(texture_.height, Shrunk(px, 4), Shrunk(py, 4));
    };
    for (int i = 0; i < 6; ++i) {  // converges, since the ground's slopes are gentle
      t = (view.distance - relief_ * height(x, y)) / dz;
      x = view.x + t * dx;
      y = view.y + t * dy;
    }
    ground_x = relief_ * (height(x + 4, y) - height(x - 4, y)) / 8;
    ground_y = relief_ * (height(x, y + 4) - height(x, y - 4)) / 8;
  }
  const cv::Vec2f slope = Linear<cv::Vec2f>(texture_.slope, Shrunk(x, 2), Shrunk(y, 2));
  const auto cosine = [&](float ax, float ay) {
    return std::clamp((dz - ax * dx - ay * dy) / std::sqrt(1 + ax * ax + ay * ay), 0.0f, 1.0f);
  };
  const float far = t * per_focal_, fall = far * far;
  float light = cosine(bumps_ * slope[0] + ground_x, bumps_ * slope[1] + ground_y) / fall;
  if (!plain_falloff_) light = std::pow(light, falloff_);
  light *= 1 - vignette_ * off_axis * off_axis;
  cv::Vec3f colour = AlbedoAt(x, y, smooth) * light;
  if (highlights_ > 0) {
    const float mirror = cosine(slope[0] + ground_x, slope[1] + ground_y);
    if (mirror > 0.99f) {  // below it a highlight is weaker than 1e-4
      const float glint = highlights_ * std::pow(mirror, kGlintPower) / std::max(fall, 0.2f);
      colour += cv::Vec3f(glint, glint, glint);
    }
  }
  return colour;
}

}  // namespace arthro::authoring
