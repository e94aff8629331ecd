#include "tests/support/compare_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "simulation/scene/image_io.h"
#include "tests/support/build_paths.h"

namespace arthro::test {
namespace {

double Grey(const std::uint8_t* rgb) { return 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2]; }

double TileSsim(const ColourImage& a, const ColourImage& b, int left, int top) {
  const int right = std::min(left + kTile, a.width), bottom = std::min(top + kTile, a.height);
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) {
      const double p = Grey(a.at(x, y)), q = Grey(b.at(x, y));
      sum_a += p;
      sum_b += q;
      aa += p * p;
      bb += q * q;
      ab += p * q;
    }
  const double n = (right - left) * (bottom - top);
  const double mean_a = sum_a / n, mean_b = sum_b / n;
  const double var_a = aa / n - mean_a * mean_a, var_b = bb / n - mean_b * mean_b;
  const double covariance = ab / n - mean_a * mean_b;
  constexpr double kC1 = 0.01 * 255 * 0.01 * 255, kC2 = 0.03 * 255 * 0.03 * 255;
  return (2 * mean_a * mean_b + kC1) * (2 * covariance + kC2) /
         ((mean_a * mean_a + mean_b * mean_b + kC1) * (var_a + var_b + kC2));
}

int ChannelDifference(const std::uint8_t* a, const std::uint8_t* b) {
  int largest = 0;
  for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(int{a[c]} - int{b[c]}));
  return largest;
}

std::filesystem::path BaselineOf(const std::string& name) {
  return std::filesystem::path(ARTHRO_SOURCE_DIR) / "tests/baselines" / (name + ".png");
}

}  // namespace

std::string PictureDifference::Sentence() const {
  if (!comparable) return "the pictures differ in size";
  return fmt::format(
      "worst tile SSIM {:.4f} at ({}, {}), asked {}; {:.3f} % of pixels off by more than {}, asked "
      "{:.1f} %; largest difference {}",
      worst_ssim, worst_tile.x, worst_tile.y, kMinTileSsim, 100 * share_off, kOff,
      100 * kMaxShareOff, max_difference);
}

PictureDifference ComparePictures(const ColourImage& actual, const ColourImage& expected) {
  PictureDifference result;
  if (actual.empty() || actual.width != expected.width || actual.height != expected.height)
    return result;
  result.comparable = true;
  result.worst_ssim = 1.0;
  for (int top = 0; top < actual.height; top += kTile)
    for (int left = 0; left < actual.width; left += kTile) {
      const double ssim = TileSsim(actual, expected, left, top);
      if (ssim < result.worst_ssim) {
        result.worst_ssim = ssim;
        result.worst_tile = {left, top};
      }
    }
  int off = 0;
  result.max_difference = 0;
  for (int y = 0; y < actual.height; ++y)
    for (int x = 0; x < actual.width; ++x) {
      const int difference = ChannelDifference(actual.at(x, y), expected.at(x, y));
      off += difference > kOff ? 1 : 0;
      result.max_difference = std::max(result.max_difference, difference);
    }
  result.share_off = double(off) / actual.width / actual.height;
  return result;
}

PictureDifference DifferenceFromBaseline(const ColourImage& actual, const std::string& name) {
  return ComparePictures(actual, ReadColourImage(BaselineOf(name)));
}

::testing::AssertionResult MatchesBaseline(const ColourImage& actual, const std::string& name) {
  namespace fs = std::filesystem;
  const fs::path baseline = BaselineOf(name);
  const char* accept = std::getenv("ARTHRO_ACCEPT_PICTURES");
  if (accept && std::string(accept) == "1") {
    WriteColourImage(baseline, actual);
    return ::testing::AssertionSuccess() << "accepted as " << baseline;
  }
  const ColourImage expected = ReadColourImage(baseline);
  const PictureDifference difference = ComparePictures(actual, expected);
  if (difference.passes()) return ::testing::AssertionSuccess() << difference.Sentence();

  const fs::path folder = fs::current_path() / "pictures";
  fs::create_directories(folder);
  WriteColourImage(folder / (name + ".actual.png"), actual);
  if (difference.comparable) {
    ColourImage diff(actual.width, actual.height);
    for (std::size_t i = 0; i < diff.rgb.size(); ++i)
      diff.rgb[i] = static_cast<std::uint8_t>(
          std::min(255, 8 * std::abs(int{actual.rgb[i]} - int{expected.rgb[i]})));
    WriteColourImage(folder / (name + ".diff.png"), diff);
  }
  return ::testing::AssertionFailure()
         << name << ": " << difference.Sentence() << "; look into " << folder;
}

}  // namespace arthro::test
