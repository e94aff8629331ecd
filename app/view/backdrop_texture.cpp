#include "app/view/backdrop_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/view/srgb.h"

namespace arthro::app {
namespace {

// The soft end takes this share of the panorama's longer edge.
constexpr double kSoftEnd = 1.0 / 40.0;

// Mean over reduction x reduction blocks; a last, thinner block takes what is left.
ColourImage Reduced(const ColourImage& image, int reduction) {
  ColourImage small((image.width + reduction - 1) / reduction,
                    (image.height + reduction - 1) / reduction);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      std::array<int, 3> sum{};
      int count = 0;
      for (int v = y * reduction; v < std::min((y + 1) * reduction, image.height); ++v)
        for (int u = x * reduction; u < std::min((x + 1) * reduction, image.width); ++u, ++count)
          for (int c = 0; c < 3; ++c) sum[static_cast<std::size_t>(c)] += image.at(u, v)[c];
      for (int c = 0; c < 3; ++c)
        small.at(x, y)[c] =
            static_cast<std::uint8_t>((sum[static_cast<std::size_t>(c)] + count / 2) / count);
    }
  return small;
}

// Box blur of one line in place, by running sum. Beyond the ends it goes on periodically or as 0.
void BlurLine(float* line, int count, int stride, int radius, bool periodic,
              std::vector<float>& copy) {
  copy.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    copy[static_cast<std::size_t>(i)] = line[static_cast<std::ptrdiff_t>(i) * stride];
  const auto at = [&](int i) {
    if (periodic) return copy[static_cast<std::size_t>((i % count + count) % count)];
    return i < 0 || i >= count ? 0.0f : copy[static_cast<std::size_t>(i)];
  };
  double sum = 0;
  for (int i = -radius; i <= radius; ++i) sum += at(i);
  for (int i = 0; i < count; ++i) {
    line[static_cast<std::ptrdiff_t>(i) * stride] = static_cast<float>(sum / (2 * radius + 1));
    sum += at(i + radius + 1) - at(i - radius);
  }
}

// 1 well inside what was imaged, falling to 0 at its edge; the fall lies inside.
std::vector<float> SoftMask(const DepthMap& depth, int width, int height, int reduction,
                            bool wraps) {
  std::vector<float> mask(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 1.0f);
  if (!depth.empty())
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (std::isnan(depth.at(x * reduction, y * reduction)))
          mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x)] = 0.0f;
  const int radius = std::max(1, static_cast<int>(std::max(width, height) * kSoftEnd / 2));
  std::vector<float> copy;
  for (int pass = 0; pass < 2; ++pass) {
    for (int y = 0; y < height; ++y)
      BlurLine(&mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)], width, 1,
               radius, wraps, copy);
    for (int x = 0; x < width; ++x)
      BlurLine(&mask[static_cast<std::size_t>(x)], height, width, radius, false, copy);
  }
  for (float& value : mask) value = std::clamp(2.0f * value - 1.0f, 0.0f, 1.0f);
  return mask;
}

// Mean colour of what was imaged and of its brightest fifth, in linear light.
void MeasureColours(BackdropTexture& texture) {
  constexpr int kBins = 64;
  std::array<glm::dvec3, kBins> sums{};
  std::array<double, kBins> counts{};
  const std::size_t step =
      std::max<std::size_t>(1, texture.rgba.size() / 4 / 200'000);  // enough for a mean
  for (std::size_t i = 0; i < texture.rgba.size() / 4; i += step) {
    const std::uint8_t* p = &texture.rgba[i * 4];
    if (p[3] < 128) continue;
    const glm::dvec3 linear{LinearFromSrgb(p[0]), LinearFromSrgb(p[1]), LinearFromSrgb(p[2])};
    const double luma = (p[0] * 2 + p[1] * 5 + p[2]) / 8.0;
    const auto bin = static_cast<std::size_t>(std::min(luma / 256.0 * kBins, kBins - 1.0));
    sums[bin] += linear;
    counts[bin] += 1;
  }
  double total = 0;
  glm::dvec3 sum{0.0};
  for (std::size_t b = 0; b < kBins; ++b) {
    total += counts[b];
    sum += sums[b];
  }
  if (total == 0) return;
  texture.mean_colour = sum / total;
  double bright = 0;
  glm::dvec3 bright_sum{0.0};
  for (std::size_t b = kBins; b-- > 0 && bright < 0.2 * total;) {
    bright += counts[b];
    bright_sum += sums[b];
  }
  texture.bright_colour = bright_sum / bright;
}

}  // namespace

BackdropTexture MakeBackdropTexture(const ColourImage& panorama, const DepthMap& depth,
                                    const Projection& projection, int max_size) {
  BackdropTexture texture;
  const int largest = std::max(panorama.width, panorama.height);
  texture.reduction = (largest + max_size - 1) / max_size;
  const ColourImage reduced =
      texture.reduction > 1 ? Reduced(panorama, texture.reduction) : ColourImage();
  const ColourImage& colours = texture.reduction > 1 ? reduced : panorama;
  texture.width = colours.width;
  texture.height = colours.height;
  texture.wraps = projection.type == ProjectionType::kEquirectangular &&
                  std::abs(360.0 * projection.px_per_deg - panorama.width) < 1.0;

  const std::vector<float> mask =
      SoftMask(depth, texture.width, texture.height, texture.reduction, texture.wraps);
  texture.rgba.resize(mask.size() * 4);
  for (std::size_t i = 0; i < mask.size(); ++i) {
    std::copy_n(&colours.rgb[i * 3], 3, &texture.rgba[i * 4]);
    texture.rgba[i * 4 + 3] = static_cast<std::uint8_t>(std::lround(mask[i] * 255.0f));
  }
  if (!depth.empty()) {
    texture.relief.resize(mask.size());
    for (int y = 0; y < texture.height; ++y)
      for (int x = 0; x < texture.width; ++x) {
        // The block's middle: relief has edges that a mean would smear into a slope.
        const int u = std::min(x * texture.reduction + texture.reduction / 2, depth.width - 1);
        const int v = std::min(y * texture.reduction + texture.reduction / 2, depth.height - 1);
        const float h = depth.at(u, v);
        texture.relief[static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width) +
                       static_cast<std::size_t>(x)] = std::isfinite(h) ? h : 0.0f;
      }
  }
  MeasureColours(texture);
  return texture;
}

}  // namespace arthro::app
