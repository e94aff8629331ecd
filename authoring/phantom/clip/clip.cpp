#include "authoring/phantom/clip/clip.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "authoring/phantom/clip/equisolid.h"
#include "authoring/phantom/clip/plane_light.h"
#include "authoring/phantom/clip/plane_noise.h"
#include "simulation/core/error.h"
#include "simulation/core/option_fields.h"

namespace arthro::authoring {
namespace {

constexpr double kWorldWidth = 4000.0 / 300, kWorldHeight = 3000.0 / 300;  // in window radii
constexpr double kMostPixels = 64e6;                                       // pixels of a plane
constexpr float kMeanLight = 0.42f;  // mean linear light that the exposure aims at
constexpr float kShoulder = 1.35f;   // k of the camera's tone curve 1 - exp(-k x)
constexpr int kLevels = 65536;

double RadiusOf(const ClipOptions& options) {
  return options.window * std::min(options.width, options.height) / 2;
}
double FocalOf(const ClipOptions& options) {
  return RadiusOf(options) / (2 * std::sin(options.field_of_view / 4));
}

Lens LensOf(const ClipOptions& options) {
  const double radius = RadiusOf(options), scale = radius / 300;
  Lens lens;
  lens.width = options.width;
  lens.height = options.height;
  lens.focal_px = FocalOf(options);
  lens.cx = options.width / 2.0 - 0.5 + 3 * scale;  // a little off the middle
  lens.cy = options.height / 2.0 - 0.5 - 2 * scale;
  lens.field_of_view = options.field_of_view;
  lens.circle = {lens.cx, lens.cy, radius};
  return lens;
}

const ClipOptions& Checked(const ClipOptions& options) {
  CheckOptions(options);
  return options;
}

int SamplesOf(const ClipOptions& options, double radius) {
  if (options.blur <= 0 || options.path == ClipPath::kStill) return 1;
  const double smear = options.blur * options.step * radius;  // px
  return std::clamp(static_cast<int>(std::ceil(smear / 2.5)) + 1, 2, 7);
}

}  // namespace

Clip::Clip(const ClipOptions& options)
    : options_(Checked(options)),
      lens_(LensOf(options)),
      radius_(RadiusOf(options)),
      path_(options, {kWorldWidth * radius_, kWorldHeight * radius_}, radius_, FocalOf(options)) {
  MakeWindow();
  const cv::Rect region = Footprint();
  if (static_cast<double>(region.width) * region.height > kMostPixels)
    throw Error(Code::kBadArgument,
                fmt::format("a clip of {} x {} px frames needs a plane of {} x {} px, which is too "
                            "much; take smaller frames",
                            options.width, options.height, region.width, region.height));
  path_.MoveOrigin(region.tl());
  texture_ = KneeTexture(options, {kWorldWidth * radius_, kWorldHeight * radius_}, region, radius_);
  FollowLight();
}

Clip::Clip(const ClipOptions& options, const cv::Mat& picture)
    : options_(Checked(options)),
      lens_(LensOf(options)),
      radius_(RadiusOf(options)),
      path_(options, cv::Size2d(picture.size()), radius_, FocalOf(options)) {
  if (picture.type() != CV_8UC3)
    throw Error(Code::kBadImage, "the picture to fly over must have three channels of 8 bits");
  MakeWindow();
  const cv::Rect need = Footprint(), have(0, 0, picture.cols, picture.rows);
  if ((need & have) != need)
    throw Error(Code::kBadImage,
                fmt::format("a picture of {} x {} px is too small to be seen through a window of "
                            "{:.0f} px on this path; take a larger picture or smaller frames",
                            picture.cols, picture.rows, 2 * radius_));
  texture_ = PictureTexture(picture, options, radius_);
  FollowLight();
}

void Clip::MakeWindow() {
  window_ = cv::Mat::zeros(options_.height, options_.width, CV_8U);
  row_span_.assign(static_cast<std::size_t>(options_.height), {0, 0});
  for (int y = 0; y < options_.height; ++y) {
    cv::Vec2i& span = row_span_[static_cast<std::size_t>(y)];
    for (int x = 0; x < options_.width; ++x) {
      // The rim's pixels are partly covered.
      const double cover =
          std::clamp(radius_ + 0.5 - std::hypot(x - lens_.cx, y - lens_.cy), 0.0, 1.0);
      if (cover <= 0) continue;
      if (span[1] == 0) span[0] = x;
      span[1] = x + 1;
      window_.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(255 * cover + 0.5);
      const cv::Vec3d ray = EquisolidRay(lens_, x, y);
      rays_.push_back(cv::Vec3f(ray));
      off_axis_.push_back(static_cast<float>(std::acos(std::clamp(ray[2], -1.0, 1.0)) /
                                             (options_.field_of_view / 2)));
    }
  }
  marks_ = MarksOf(options_, {lens_.cx, lens_.cy}, radius_);
  clouds_ = Clouds(options_, radius_);
  code_.resize(kLevels);
  for (int i = 0; i < kLevels; ++i)
    code_[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(255 * std::pow(i / (kLevels - 1.0), 1 / options_.gamma) + 0.5);
  // Blank frames are spaced apart and away from both ends.
  is_blank_.assign(static_cast<std::size_t>(options_.frames), false);
  for (int i = 0; i < options_.blank; ++i) {
    Random random = RandomOf(i, 3);
    const double width = options_.frames / (options_.blank + 1.0);
    const auto at = static_cast<std::size_t>((i + 0.5 + random.Uniform(0.2, 0.8)) * width);
    if (at > 0 && at + 1 < is_blank_.size()) is_blank_[at] = true;
  }
}

// Union of all frames' views of the plane, with a border for smooth sampling.
cv::Rect Clip::Footprint() const {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (int i = 0; i < options_.frames; ++i)
    for (const double t : {i - 0.5, i + 0.5}) {
      const cv::Matx33d panorama_from_ray = PanoramaFromRay(path_.At(t, i));
      for (int k = 0; k < 32; ++k) {
        const double a = 2 * CV_PI * k / 32;
        cv::Vec3d ray = EquisolidRay(lens_, lens_.cx + (radius_ + 2) * std::cos(a),
                                     lens_.cy + (radius_ + 2) * std::sin(a));
        ray = panorama_from_ray * ray;
        if (!(ray[2] > 0.05))
          throw Error(Code::kBadArgument,
                      "this field of view, tilted like this, looks past the plane; take a smaller "
                      "field of view or tilt");
        left = std::min(left, ray[0] / ray[2]);
        right = std::max(right, ray[0] / ray[2]);
        top = std::min(top, ray[1] / ray[2]);
        bottom = std::max(bottom, ray[1] / ray[2]);
      }
    }
  const int border = 4 + static_cast<int>(0.02 * radius_ + options_.relief * radius_);
  const cv::Point first(static_cast<int>(std::floor(left)) - border,
                        static_cast<int>(std::floor(top)) - border);
  const cv::Point last(static_cast<int>(std::ceil(right)) + border,
                       static_cast<int>(std::ceil(bottom)) + border);
  return {first, last};
}

Random Clip::RandomOf(int index, int what) const {
  Random mixed(static_cast<std::uint64_t>(options_.seed) * 1000003 +
               static_cast<std::uint64_t>(index) * 8 + static_cast<std::uint64_t>(what));
  return Random(mixed.Next());
}

// The camera's exposure follows the mean with a delay; a subset of the pixels measures it well
// enough.
void Clip::FollowLight() {
  const PlaneLight light(texture_, options_, radius_, lens_.focal_px);
  const std::size_t stride = std::max<std::size_t>(1, rays_.size() / 3001);
  float exposure = 0;
  for (int i = 0; i < options_.frames; ++i) {
    const PlaneLight::View view = PlaneLight::ViewOf(PoseOf(i));
    float sum = 0;
    int count = 0;
    for (std::size_t k = 0; k < rays_.size(); k += stride, ++count) {
      const cv::Vec3f colour = light.Along(view, rays_[k], off_axis_[k], false);
      sum += (colour[0] + colour[1] + colour[2]) / 3;
    }
    const float wanted = kMeanLight * static_cast<float>(count) / std::max(sum, 1e-6f);
    exposure = i == 0 ? wanted : 0.7f * exposure + 0.3f * wanted;
    Random random = RandomOf(i, 1);
    const double flicker = 1 + options_.flicker * NormalOf(random.Next());
    const double step = i >= (options_.frames + 1) / 2 ? options_.exposure_step : 1.0;
    exposure_.push_back(exposure * static_cast<float>(std::max(0.1, flicker) * step));
  }
}

cv::Mat Clip::LightOf(int index) const {
  cv::Mat picture = cv::Mat::zeros(options_.height, options_.width, CV_32FC3);
  const PlaneLight light(texture_, options_, radius_, lens_.focal_px);
  const int samples = SamplesOf(options_, radius_);
  const float share = exposure_[static_cast<std::size_t>(index)] / static_cast<float>(samples);
  for (int k = 0; k < samples; ++k) {
    const double t = samples == 1 ? 0.0 : options_.blur * ((k + 0.5) / samples - 0.5);  // frames
    const PlaneLight::View view = PlaneLight::ViewOf(path_.At(index + t, index));
    std::size_t n = 0;
    for (int y = 0; y < picture.rows; ++y) {
      const cv::Vec2i span = row_span_[static_cast<std::size_t>(y)];
      cv::Vec3f* row = picture.ptr<cv::Vec3f>(y);
      for (int x = span[0]; x < span[1]; ++x, ++n)
        row[x] += share * light.Along(view, rays_[n], off_axis_[n], samples < 3);
    }
  }
  return picture;
}

cv::Mat Clip::Frame(int index) const {
  if (index < 0 || index >= options_.frames)
    throw Error(Code::kBadArgument, fmt::format("frame {} of a clip of {} frames does not exist",
                                                index, options_.frames));
  cv::Mat picture;
  const cv::Point2d centre(lens_.cx, lens_.cy);
  if (IsBlank(index)) {
    picture = cv::Mat(options_.height, options_.width, CV_32FC3, cv::Scalar(0.33, 0.072, 0.06));
  } else {
    picture = LightOf(index);
    AddHaze(clouds_, options_.haze, index, picture);
    AddDebris(options_, radius_, index, picture);
    if (options_.tool) AddTool(options_, centre, radius_, index, picture);
  }
  cv::Mat frame = cv::Mat::zeros(picture.size(), CV_8UC3);
  const float floor = static_cast<float>(options_.noise * options_.noise),
              shot = static_cast<float>(options_.shot_noise * options_.shot_noise);
  Random random = RandomOf(index, 2);
  for (int y = 0; y < picture.rows; ++y) {
    const cv::Vec2i span = row_span_[static_cast<std::size_t>(y)];
    const cv::Vec3f* light = picture.ptr<cv::Vec3f>(y);
    cv::Vec3b* out = frame.ptr<cv::Vec3b>(y);
    for (int x = span[0]; x < span[1]; ++x) {
      std::uint64_t bits = random.Next();
      const int cover = window_.at<std::uint8_t>(y, x);
      const float dirt =
          marks_.dirt.empty() ? 0.0f : 0.9f / 255 * marks_.dirt.at<std::uint8_t>(y, x);
      const float letters =
          marks_.letters.empty() ? 0.0f : 1.0f / 255 * marks_.letters.at<std::uint8_t>(y, x);
      for (int c = 0; c < 3; ++c, bits >>= 12) {
        float v = 1 - std::exp(-kShoulder * light[x][c] * (1 - dirt));
        v += std::sqrt(floor + shot * v) * NormalOf(bits);
        v += letters * (0.95f - v);  // inserted by the camera, over the noise
        const int level = std::clamp(static_cast<int>(v * (kLevels - 1) + 0.5f), 0, kLevels - 1);
        out[x][c] =
            static_cast<std::uint8_t>((code_[static_cast<std::size_t>(level)] * cover + 127) / 255);
      }
    }
  }
  return frame;
}

cv::Matx33d Clip::PanoramaFromRectified(int index, const RectifiedView& view) const {
  const double f = view.focal_px;
  const cv::Matx33d ray_from_rectified(1 / f, 0, -view.cx / f, 0, 1 / f, -view.cy / f, 0, 0, 1);
  const cv::Matx33d h = PanoramaFromRay(PoseOf(index)) * ray_from_rectified;
  return h * (1 / h(2, 2));
}

bool Clip::IsBlank(int index) const { return is_blank_.at(static_cast<std::size_t>(index)); }

cv::Mat Clip::Panorama() const {
  cv::Mat picture(texture_.albedo.size(), CV_8UC3);
  for (int y = 0; y < picture.rows; ++y) {
    const cv::Vec3w* albedo = texture_.albedo.ptr<cv::Vec3w>(y);
    cv::Vec3b* out = picture.ptr<cv::Vec3b>(y);
    for (int x = 0; x < picture.cols; ++x)
      for (int c = 0; c < 3; ++c) out[x][c] = code_[albedo[x][c]];
  }
  return picture;
}

cv::Mat Clip::ToolMask(int index) const {
  cv::Mat mask = cv::Mat::zeros(options_.height, options_.width, CV_8U);
  if (options_.tool && !IsBlank(index))
    ToolCover(options_, {lens_.cx, lens_.cy}, radius_, index).convertTo(mask, CV_8U, 255);
  return mask;
}

cv::Mat Clip::MarksMask() const {
  if (!options_.marks) return cv::Mat::zeros(options_.height, options_.width, CV_8U);
  return cv::max(marks_.dirt, marks_.letters);
}

}  // namespace arthro::authoring
