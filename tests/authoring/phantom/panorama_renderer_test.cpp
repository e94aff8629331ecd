// Antialiasing of the phantom's panorama: creases and silhouettes against 8 x 8 samples per pixel,
// at the resolution of size M.
#include "authoring/phantom/look/panorama_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

namespace arthro::authoring {
namespace {

constexpr int kPictureWidth = 120, kPictureHeight = 72;
constexpr double kPxPerDeg = 10.24;  // size M
constexpr int kFine = 8;             // samples per side of a pixel of the reference

// Window of the panorama around a direction; `fine` pixels stand for one along each side.
PhantomPicture DrawWindow(const Cavity& cavity, double latitude_deg, double longitude_deg,
                          int fine) {
  const VesselTrees vessels(cavity.seed);
  const PhantomView view{cavity, vessels, nullptr, LookOf(Difficulty::kEasy)};
  Projection whole, window;
  whole.type = window.type = ProjectionType::kEquirectangular;
  whole.px_per_deg = 2.0;
  whole.centre_px = {199.5, 149.5};
  const double exposure = ExposureOf(view, whole, 400, 300);
  // Pixel i of the coarse picture covers pixels fine * i to fine * i + fine - 1 of the fine one.
  window.px_per_deg = kPxPerDeg * fine;
  window.centre_px = {((kPictureWidth - 1) / 2.0 - kPxPerDeg * longitude_deg + 0.5) * fine - 0.5,
                      ((kPictureHeight - 1) / 2.0 + kPxPerDeg * latitude_deg + 0.5) * fine - 0.5};
  return RenderPanorama(view, window, kPictureWidth * fine, kPictureHeight * fine, exposure, 2, {},
                        "");
}

// Mean over the samples of one channel of a pixel.
double MeanOf(const ColourImage& fine, int x, int y, int channel) {
  double sum = 0;
  for (int j = 0; j < kFine; ++j)
    for (int i = 0; i < kFine; ++i) sum += fine.at(kFine * x + i, kFine * y + j)[channel];
  return sum / (kFine * kFine);
}

// Share of pixels that differ from the mean of their samples by more than `levels` in a channel.
double ShareOff(const ColourImage& picture, const ColourImage& fine, double levels) {
  int off = 0;
  for (int y = 0; y < kPictureHeight; ++y)
    for (int x = 0; x < kPictureWidth; ++x) {
      double most = 0;
      for (int c = 0; c < 3; ++c)
        most = std::max(most, std::abs(picture.at(x, y)[c] - MeanOf(fine, x, y, c)));
      off += most > levels;
    }
  return static_cast<double>(off) / (kPictureWidth * kPictureHeight);
}

struct Place {
  const char* what;
  double latitude_deg, longitude_deg;
};

// A crease has no step of depth: its two sides meet there at an angle.
TEST(PhantomPanorama, CreasesOfTheFatPadAreNoStairs) {
  const Cavity cavity = MakeCavity(1);
  for (const Place& place :
       {Place{"left of the folds", -36, 8}, Place{"right of the folds", -35.5, 17}}) {
    const PhantomPicture picture = DrawWindow(cavity, place.latitude_deg, place.longitude_deg, 1),
                         fine = DrawWindow(cavity, place.latitude_deg, place.longitude_deg, kFine);
    const double share = ShareOff(picture.colour, fine.colour, 8.0);
    std::printf("%s: %.3f %% of the pixels more than 8 levels off\n", place.what, 100 * share);
    EXPECT_LT(share, 0.0005) << place.what;
  }
}

}  // namespace
}  // namespace arthro::authoring
