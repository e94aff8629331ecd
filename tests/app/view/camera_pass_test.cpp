// The camera behind the scope, on drawn pictures.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/view/exposure/picture_statistics.h"
#include "simulation/core/units.h"
#include "tests/app/view/lit_scene.h"
#include "tests/app/view/view_scene.h"

namespace arthro::test {
namespace {

using app::CameraFeatures;
using app::Picture;
using app::PictureFromPose;

constexpr int kPassSize = 256;
constexpr LensCamera kNothing{0, 0, 0, 0};

class CameraPassView : public ViewTest {
 protected:
  // A forward view of a panorama, without relief or tissues.
  Picture Forward(const ColourImage& panorama, const LensCamera& camera) {
    view_->SetTissues({}, {});
    view_->SetBackdrop(panorama, {}, PlainBackdrop(panorama.width, panorama.height));
    Picture picture = PictureFromPose({0, 0, 0, 0.01}, 0.0, std::numbers::pi / 2);
    picture.camera = camera;
    picture.features = CameraFeatures::kFringe;
    return picture;
  }
  ColourImage Drawn(const Picture& picture, int size = kPassSize) {
    view_->Render(picture, size);
    return view_->ReadPixels();
  }
};

// Grey of two levels, parted along a column of the panorama.
ColourImage Halves(int width, int height, double column) {
  ColourImage image = Grey(width, height, 60);
  for (int y = 0; y < height; ++y)
    for (int x = static_cast<int>(column); x < width; ++x)
      std::fill_n(image.at(x, y), 3, std::uint8_t{160});
  return image;
}

// Place in the middle row where a channel crosses the mean of its ends, px.
double Crossing(const ColourImage& image, int channel, int from, int to) {
  const auto level = [&](int x) { return double(image.at(x, image.height / 2)[channel]); };
  const double mean = 0.5 * (level(from) + level(to));
  for (int x = from; x < to; ++x)
    if (level(x) <= mean && level(x + 1) > mean)
      return x + (mean - level(x)) / (level(x + 1) - level(x));
  ADD_FAILURE() << "no edge between " << from << " and " << to;
  return 0;
}

TEST_F(CameraPassView, PlainPictureHasNoCamera) {
  const LoadedScene loaded = MakeViewScene();
  view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
  view_->SetTissues(loaded.scene.tissues, loaded.surfaces);
  Picture picture = PictureFromPose({-0.1, 0.1, 0.2, 0.01}, 0.5, std::numbers::pi / 2);
  picture.plain = true;
  const ColourImage plain = Drawn(picture);
  picture.camera = LensCamera();
  EXPECT_EQ(Drawn(picture).rgb, plain.rgb);
  picture.plain = false;
  EXPECT_NE(Drawn(picture).rgb, plain.rgb);
}

TEST_F(CameraPassView, OcclusionLeavesLevelGroundAsItIs) {
  Picture picture = Forward(Halves(1024, 1024, 680), kNothing);
  picture.features = CameraFeatures::kEdges;
  const ColourImage without = Drawn(picture);
  picture.features = CameraFeatures::kOcclusion;
  EXPECT_EQ(Drawn(picture).rgb, without.rgb);
}

// A part that stands out by a millimetre darkens the ground beside it, and nothing a reach away.
TEST_F(CameraPassView, OcclusionDarkensTheFootOfAStep) {
  Picture picture = Forward(Grey(1024, 1024, 120), kNothing);
  DepthMap depth(1024, 1024);
  for (int y = 0; y < 1024; ++y)
    for (int x = 0; x < 1024; ++x) depth.at(x, y) = x < 512 ? 0.0f : 1e-3f;
  view_->SetBackdrop(Grey(1024, 1024, 120), depth, PlainBackdrop(1024, 1024));
  picture.relief = app::kUsualRelief;
  picture.features = CameraFeatures::kEdges;
  const ColourImage without = Drawn(picture);
  picture.features = CameraFeatures::kOcclusion;
  const ColourImage with = Drawn(picture);
  // Light of both pictures, relative to the middle of the level part on the left.
  constexpr int kRow = kPassSize / 2, kLevel = kPassSize / 4;
  const auto light = [&](const ColourImage& image, int x) {
    return double(image.at(x, kRow)[1]) / image.at(kLevel, kRow)[1];
  };
  double darkest = 1.0;
  for (int x = kPassSize / 8; x < kPassSize * 7 / 8; ++x) {
    const double share = light(with, x) / light(without, x);
    darkest = std::min(darkest, share);
    if (std::abs(x - kPassSize / 2) > kPassSize / 8) {
      EXPECT_NEAR(share, 1.0, 0.02) << x;
    }
  }
  std::printf("darkest place at the foot: %.2f of its light\n", darkest);
  EXPECT_LT(darkest, 0.9);
}

// A post of 1 mm darkens the ground around it smoothly. Without a change of direction from pixel to
// pixel each of the eight pairs draws a copy of the post, whose outline is a jump by a pair's loss.
TEST_F(CameraPassView, OcclusionOfAPostHasNoCopiesOfIt) {
  constexpr int kSide = 1024, kMiddle = kSide / 2, kRadius = 24;
  constexpr std::uint8_t kGround = 200;
  ColourImage panorama = Grey(kSide, kSide, kGround);
  DepthMap depth(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      if (std::hypot(x - kMiddle, y - kMiddle) < kRadius) {
        depth.at(x, y) = 1e-3f;
        std::fill_n(panorama.at(x, y), 3, std::uint8_t{60});
      }
  Picture picture = Forward(panorama, kNothing);
  picture.view = PictureFromPose({0, 0, 0, 0.04}, 0.0, std::numbers::pi / 2).view;
  view_->SetBackdrop(panorama, depth, PlainBackdrop(kSide, kSide));
  picture.relief = app::kUsualRelief;
  picture.features = CameraFeatures::kEdges;
  constexpr int kLarge = 512, kBeside = 12;  // px; at the foot itself the light falls steeply
  const ColourImage without = Drawn(picture, kLarge);
  picture.features = CameraFeatures::kOcclusion;
  const ColourImage with = Drawn(picture, kLarge);
  const auto is_ground = [&](int x, int y) {
    for (int v = y - kBeside; v <= y + kBeside; ++v)
      for (int u = x - kBeside; u <= x + kBeside; ++u)
        if (without.at(u, v)[1] < kGround / 2) return false;
    return true;
  };
  const auto share = [&](int x, int y) { return double(with.at(x, y)[1]) / without.at(x, y)[1]; };
  double darkest = 1, jump = 0;
  for (int y = kLarge / 4; y < kLarge * 3 / 4; ++y)
    for (int x = kLarge / 4; x < kLarge * 3 / 4; ++x) {
      if (!is_ground(x, y) || !is_ground(x + 1, y)) continue;
      darkest = std::min(darkest, share(x, y));
      jump = std::max(jump, std::abs(share(x + 1, y) - share(x, y)));
    }
  std::printf("darkest ground %.3f of its light, largest jump %.3f\n", darkest, jump);
  EXPECT_LT(darkest, 0.97);
  // Half the loss by one of eight pairs (0.55 / 8), and the rounding of two pairs of bytes.
  EXPECT_LT(jump, 0.5 * 0.55 / 8 + 2.0 / kGround);
}

// Occlusion reaches 1.4 mm. Where seven standard errors are as high, rises are noise, and shade
// would draw them as grey dashes.
TEST_F(CameraPassView, NoiseOfADepthMapIsNotShaded) {
  constexpr int kSide = 1024, kCell = 64;
  const ColourImage grey = Grey(kSide, kSide, 120);
  DepthMap rough(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      rough.at(x, y) = (x / kCell + y / kCell) % 2 == 0 ? 0.0f : 2e-3f;
  // Share of the pixels that occlusion changes, by the standard error of the depths in m.
  const auto shaded = [&](float error) {
    DepthMap sigma(kSide, kSide);
    std::fill(sigma.relief.begin(), sigma.relief.end(), error);
    Picture picture = Forward(grey, kNothing);
    view_->SetBackdrop(grey, rough, PlainBackdrop(kSide, kSide), sigma);
    picture.relief = app::kUsualRelief;
    picture.features = CameraFeatures::kEdges;
    const ColourImage without = Drawn(picture);
    picture.features = CameraFeatures::kOcclusion;
    const ColourImage with = Drawn(picture);
    int changed = 0;
    for (std::size_t i = 0; i < with.rgb.size(); i += 3) changed += with.rgb[i] != without.rgb[i];
    return static_cast<double>(changed) / (kPassSize * kPassSize);
  };
  const double known = shaded(0.19e-3f), noisy = shaded(0.21e-3f);
  std::printf("shaded in known depths: %.1f %%, in noise: %.1f %%\n", 100 * known, 100 * noisy);
  EXPECT_GT(known, 0.05);
  EXPECT_EQ(noisy, 0.0);
}

TEST_F(CameraPassView, SamePictureGivesTheSameBytes) {
  const LoadedScene loaded = MakeViewScene();
  view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
  Picture picture = PictureFromPose({-0.1, 0.1, 0.2, 0.01}, 0.5, std::numbers::pi / 2);
  picture.camera = LensCamera();
  const ColourImage first = Drawn(picture);
  Picture other = picture;
  other.view.tip.x += 1e-3;
  EXPECT_NE(Drawn(other).rgb, first.rgb);
  EXPECT_EQ(Drawn(picture).rgb, first.rgb);
}

// Displacement at r window radii is fringe r^3 radii: red outwards, blue inwards, each at its own
// r. A bilinear edge is located to a tenth of a pixel.
TEST_F(CameraPassView, FringeMovesRedOutwardsAndBlueInwards) {
  LensCamera camera = kNothing;
  camera.fringe = 0.02;
  const ColourImage image = Drawn(Forward(Halves(1024, 1024, 680), camera));
  const double red = Crossing(image, 0, 140, 240), green = Crossing(image, 1, 140, 240),
               blue = Crossing(image, 2, 140, 240);
  const auto moved = [&](double place) {
    return 128 * camera.fringe * std::pow((place - 127.5) / 128, 3);
  };
  ASSERT_GT(moved(green), 0.5);
  EXPECT_NEAR(red - green, moved(red), 0.15);
  EXPECT_NEAR(blue - green, -moved(blue), 0.15);
}

// The same for a fringe of less than a pixel, which is interpolated between neighbouring pixels.
TEST_F(CameraPassView, NearFringeMovesColoursByPartsOfAPixel) {
  LensCamera camera = kNothing;
  camera.fringe = 0.006;
  camera.rim_blur = 0.01;
  const ColourImage image = Drawn(Forward(Halves(1024, 1024, 700), camera));
  const double green = Crossing(image, 1, 140, 250);
  const double r = (green - 127.5) / 128, moved = camera.fringe * r * r * r * 128;
  ASSERT_GT(moved, 0.2);
  EXPECT_NEAR(Crossing(image, 0, 140, 250) - green, moved, 0.15);
  EXPECT_NEAR(Crossing(image, 2, 140, 250) - green, -moved, 0.15);
}

// The widest fringe that is interpolated (0.8 px at the rim) and the narrowest that is filtered.
TEST_F(CameraPassView, InterpolatedFringeIsThatOfTheFilter) {
  const LoadedScene loaded = MakeViewScene();
  view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
  view_->SetTissues(loaded.scene.tissues, loaded.surfaces);
  Picture picture = PictureFromPose({-0.1, 0.1, 0.2, 0.01}, 0.5, std::numbers::pi / 2);
  picture.camera = LensCamera();
  picture.camera->grain = 0;
  picture.camera->fringe = 1.6 / kPassSize;
  const ColourImage interpolated = Drawn(picture);
  picture.camera->fringe *= 1.0001;
  const ColourImage filtered = Drawn(picture);
  int off = 0;
  double squares = 0;
  for (std::size_t i = 0; i < filtered.rgb.size(); ++i) {
    const int difference = int(interpolated.rgb[i]) - int(filtered.rgb[i]);
    off += std::abs(difference) > 2 ? 1 : 0;
    squares += difference * difference;
  }
  const auto count = static_cast<double>(filtered.rgb.size());
  std::printf("interpolated fringe: %.3f %% off by more than 2 levels, rms %.3f\n",
              100 * off / count, std::sqrt(squares / count));
  EXPECT_NE(interpolated.rgb, filtered.rgb);
  EXPECT_LT(off, 0.01 * count);
  EXPECT_LT(std::sqrt(squares / count), 0.8);
}

TEST_F(CameraPassView, CentreIsSharperThanTheRim) {
  const auto steepest = [&](double column, const LensCamera& camera, int from, int to) {
    const ColourImage image = Drawn(Forward(Halves(1024, 1024, column), camera));
    int most = 0;
    for (int x = from; x < to; ++x)
      most = std::max(most, image.at(x + 1, kPassSize / 2)[1] - image.at(x, kPassSize / 2)[1]);
    return most;
  };
  LensCamera soft = kNothing, sharp = kNothing;
  soft.rim_blur = 1;
  sharp.sharpening = 1;
  // At 0.87 radii 0.56 of the blur counts: either side of a step moves by a quarter of that.
  EXPECT_LT(steepest(700, soft, 220, 250), 0.8 * steepest(700, kNothing, 220, 250));
  EXPECT_GT(steepest(512, sharp, 100, 150), 1.2 * steepest(512, kNothing, 100, 150));
  EXPECT_EQ(steepest(512, soft, 100, 150), steepest(512, kNothing, 100, 150));
}

// The foot of an edge of 100 levels is drawn 18 levels too dark by a real camera. A larger halo is
// a second outline, and a row of beads along a slanting edge.
TEST_F(CameraPassView, EdgeHasNoHalo) {
  constexpr int kSide = 1024;
  ColourImage slanting = Grey(kSide, kSide, 60);
  for (int y = 0; y < kSide; ++y)
    for (int x = kSide / 4 + y / 2; x < kSide; ++x)
      std::fill_n(slanting.at(x, y), 3, std::uint8_t{160});
  LensCamera sharp = kNothing;
  sharp.sharpening = 1;
  for (const ColourImage& panorama : {Halves(kSide, kSide, kSide / 2), slanting}) {
    const ColourImage without = Drawn(Forward(panorama, kNothing));
    const ColourImage with = Drawn(Forward(panorama, sharp));
    int most = 0;
    for (int y = kPassSize / 4; y < kPassSize * 3 / 4; ++y)
      for (int x = kPassSize / 4; x < kPassSize * 3 / 4; ++x)
        most = std::max(most, std::abs(with.at(x, y)[1] - without.at(x, y)[1]));
    const double gain = view_->exposure().gain;
    std::printf("largest halo: %d levels at a gain of %.2f\n", most, gain);
    EXPECT_GT(most, 0);
    EXPECT_LE(most, 18 * gain + 1);  // and rounding
  }
}

TEST_F(CameraPassView, GrainIsAtMostItsAmplitudeAndHasNoMean) {
  LensCamera camera = kNothing;
  const ColourImage clean = Drawn(Forward(Grey(256, 256, 120), camera));
  camera.grain = 3;
  const ColourImage grainy = Drawn(Forward(Grey(256, 256, 120), camera));
  int most = 0, count = 0;
  double sum = 0;
  for (int y = 78; y < 178; ++y)
    for (int x = 78; x < 178; ++x) {
      const int off = grainy.at(x, y)[1] - clean.at(x, y)[1];
      most = std::max(most, std::abs(off));
      sum += off;
      ++count;
    }
  EXPECT_GE(most, 2);
  EXPECT_LE(most, 3 + 1);  // and rounding
  // The mean of 10 000 triangular values of variance 9/6 is 0.012 rms; five of them, and the
  // rounding of the clean level.
  EXPECT_NEAR(sum / count, 0, 0.06 + 0.5);
  EXPECT_EQ(grainy.at(0, 0)[1], 0) << "the surround stays black";
}

TEST_F(CameraPassView, GrainOverFootageIsHalf) {
  LensCamera camera = kNothing;
  camera.grain = 8;
  const Picture picture = Forward(Grey(256, 256, 120), camera);
  const auto most = [&] {
    const ColourImage grainy = Drawn(picture);
    int low = 255, high = 0;
    for (int y = 78; y < 178; ++y)
      for (int x = 78; x < 178; ++x) {
        low = std::min(low, int(grainy.at(x, y)[1]));
        high = std::max(high, int(grainy.at(x, y)[1]));
      }
    return high - low;
  };
  const int computed = most();
  Backdrop footage = PlainBackdrop(256, 256);
  footage.footage = "footage.json";
  view_->SetBackdrop(Grey(256, 256, 120), {}, footage);
  const int filmed = most();
  EXPECT_GT(computed, 12);
  EXPECT_NEAR(filmed, computed / 2, 1);
}

TEST_F(CameraPassView, SharpeningOverFootageIsATenthMore) {
  const ColourImage halves = Halves(1024, 1024, 512);
  const auto drawn = [&](const char* footage, double sharpening) {
    LensCamera camera = kNothing;
    camera.sharpening = sharpening;
    const Picture picture = Forward(halves, camera);
    Backdrop backdrop = PlainBackdrop(1024, 1024);
    backdrop.footage = footage;
    view_->SetBackdrop(halves, {}, backdrop);
    return Drawn(picture).rgb;
  };
  const auto filmed = drawn("footage.json", 2);
  EXPECT_EQ(filmed, drawn("", 2.2));
  EXPECT_NE(filmed, drawn("", 2));
}

// The live picture has one ray per pixel. Its edges are held against 16 rays per pixel.
TEST_F(CameraPassView, StairsOfModelsAreSmoothed) {
  const LoadedScene loaded = MakeViewScene();
  view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
  std::vector<Tissue> tissues = loaded.scene.tissues;
  tissues[0].colour = {0.9, 0.85, 0.8};
  view_->SetTissues(tissues, loaded.surfaces);
  Picture picture = PictureFromPose({-0.12, 0.05, 0.2, 0.01}, 0.5, std::numbers::pi / 2);
  picture.relief = app::kUsualRelief;
  const ColourImage fine = Drawn(picture, 4 * kPassSize);
  ColourImage reference(kPassSize, kPassSize);
  std::vector<bool> is_edge(static_cast<std::size_t>(kPassSize) * kPassSize);
  for (int y = 0; y < kPassSize; ++y)
    for (int x = 0; x < kPassSize; ++x) {
      std::array<int, 3> sum{};
      int low = 255, high = 0;
      for (int k = 0; k < 16; ++k) {
        const std::uint8_t* at = fine.at(4 * x + k % 4, 4 * y + k / 4);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += at[c];
        low = std::min<int>(low, at[1]), high = std::max<int>(high, at[1]);
      }
      for (std::size_t c = 0; c < 3; ++c)
        reference.at(x, y)[c] = static_cast<std::uint8_t>((sum[c] + 8) / 16);
      is_edge[static_cast<std::size_t>(y) * kPassSize + static_cast<std::size_t>(x)] =
          high - low > 25 && std::hypot(x - 127.5, y - 127.5) < 118;
    }
  const auto error = [&](const ColourImage& drawn) {
    double squares = 0;
    int count = 0;
    for (int y = 0; y < kPassSize; ++y)
      for (int x = 0; x < kPassSize; ++x) {
        if (!is_edge[static_cast<std::size_t>(y) * kPassSize + static_cast<std::size_t>(x)])
          continue;
        squares += std::pow(drawn.at(x, y)[1] - reference.at(x, y)[1], 2);
        ++count;
      }
    EXPECT_GT(count, 100);
    return std::sqrt(squares / count);
  };
  // Only the smoothing: the response of the exposure is undone by metering nothing.
  const double stairs = error(Drawn(picture));
  picture.camera = kNothing;
  picture.features = CameraFeatures::kFringe;
  const ColourImage unsmoothed = Drawn(picture);
  const app::CameraExposure exposure = view_->exposure();
  picture.features = CameraFeatures::kEdges;
  const ColourImage smoothed = Drawn(picture);
  // The response is undone by its table: both pictures have the same one.
  const auto undone = [&](ColourImage image) {
    std::array<int, 256> stored{};
    for (int level = 255; level >= 0; --level) {
      const double shown = 255 * app::CameraResponse(exposure, level / 255.0);
      for (int out = static_cast<int>(shown + 0.5); out < 256 && stored[std::size_t(out)] == 0;
           ++out)
        stored[static_cast<std::size_t>(out)] = level;
    }
    for (std::uint8_t& value : image.rgb) value = static_cast<std::uint8_t>(stored[value]);
    return image;
  };
  EXPECT_NEAR(error(undone(unsmoothed)), stairs, 0.15 * stairs);
  const double left = error(undone(smoothed));
  std::printf("edges: %.1f of 255 rms with stairs, %.1f smoothed\n", stairs, left);
  EXPECT_LT(left, 0.7 * stairs);
}

TEST_F(CameraPassView, FourRaysPerPixelGiveThePictureItsOwnSize) {
  Picture picture = Forward(Halves(1024, 1024, 512), LensCamera());
  picture.rays = 2;
  const ColourImage image = Drawn(picture);
  EXPECT_EQ(image.width, kPassSize);
  EXPECT_EQ(view_->ReadDistances().size(), std::size_t{4} * kPassSize * kPassSize);
  picture.rays = 1;
  const ColourImage once = Drawn(picture);
  // The exposure must not jump when a picture at rest gets its four rays.
  EXPECT_NEAR(image.at(60, kPassSize / 2)[1], once.at(60, kPassSize / 2)[1], 4);
  EXPECT_NEAR(image.at(200, kPassSize / 2)[1], once.at(200, kPassSize / 2)[1], 4);
}

// The smoothing of edges has marks of its own size, which must not bound a larger picture.
TEST_F(CameraPassView, PicturesWithoutSmoothingAreWholeAfterASmallerOneWithIt) {
  Picture still = Forward(Grey(1024, 1024, 120), kNothing);
  still.rays = 2;
  Picture fringed = still, smoothed = still;
  fringed.rays = smoothed.rays = 1;
  smoothed.features = CameraFeatures::kEdges;
  const ColourImage whole = Drawn(still), whole_fringed = Drawn(fringed);
  for (int round = 0; round < 2; ++round) {
    Drawn(smoothed, kPassSize / 2);
    EXPECT_EQ(Drawn(still).rgb, whole.rgb);
    Drawn(smoothed, kPassSize / 2);
    EXPECT_EQ(Drawn(fringed).rgb, whole_fringed.rgb);
  }
}

// A sweep of 6 mm in steps of 0.1 mm past the ring: a hand's second. No step may be seen as a
// flicker, which begins at a change of contrast of 1 to 2 %.
TEST_F(CameraPassView, ExposureIsSteadyInMotion) {
  LoadedScene loaded = MakeViewScene();
  loaded.scene.backdrop.relight = 0.6;
  view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
  view_->SetTissues(loaded.scene.tissues, loaded.surfaces);
  double before = 0;
  for (int i = 0; i <= 60; ++i) {
    Picture picture =
        PictureFromPose({-0.15 + 0.003 * i, 0.05, 0.2, 0.01}, 0.5, std::numbers::pi / 2);
    picture.camera = LensCamera();
    view_->Render(picture, 128);
    const double now = app::CameraResponse(view_->exposure(), 0.5);
    if (i > 0) {
      EXPECT_LT(std::abs(now - before), 0.02) << i;
    }
    before = now;
  }
}

// The goal of a lit scene at first glance.
TEST_F(CameraPassView, PictureUsesItsRange) {
  LoadedScene loaded = MakeViewScene();
  loaded.scene.backdrop.relight = 0.6;
  app::StillPictures pictures(loaded);
  app::PictureStatistics before, after;
  for (const bool has_camera : {false, true}) {
    Picture picture = PictureFromPose({-0.1, 0.1, 0.2, 0.01}, 0.5, std::numbers::pi / 2);
    picture.relief = app::kUsualRelief;
    if (has_camera) picture.camera = LensCamera();
    (has_camera ? after : before) = app::MeasurePicture(
        pictures.Draw(picture, 512), app::DiscMask(512, 512, 255.5, 255.5, 0.9 * 256));
  }
  std::printf("p1 %.0f to %.0f, p99 %.0f to %.0f, clipped %.2f %%\n", before.p1, after.p1,
              before.p99, after.p99, 100 * after.clipped);
  EXPECT_LE(after.p1, std::max(25.0, before.p1 - 20));
  EXPECT_GE(after.p99, 240);
  EXPECT_LE(after.clipped, 0.06);
}

}  // namespace
}  // namespace arthro::test
