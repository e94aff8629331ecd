// Disturbances of a picture: each has the size of its formula, and none acts when all are off.
#include "app/view/drawing/disturbances.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <numeric>

#include <GL/gl.h>

#include "app/view/disturbances/drifting_bits.h"
#include "simulation/core/units.h"
#include "tests/app/view/disturbed_view.h"

namespace arthro::test {
namespace {

using app::Disturbances;
using app::Picture;
using app::PictureFromPose;

double Light(std::uint8_t byte) { return std::pow(byte / 255.0, 2.2); }

// Every strength alone.
std::vector<Disturbances> EachAt(double strength) {
  std::vector<Disturbances> all;
  for (double Disturbances::*field :
       {&Disturbances::haze, &Disturbances::bubbles, &Disturbances::debris, &Disturbances::fog,
        &Disturbances::near_blur, &Disturbances::far_blur, &Disturbances::overexposure}) {
    all.emplace_back();
    all.back().*field = strength;
  }
  return all;
}

TEST_F(DisturbedView, WithoutStrengthsTheBytesAndTheTextureStay) {
  ShowJoint();
  picture_.instrument = ProbeInFront();
  const ColourImage clear = Draw({});
  const unsigned texture = view_->TextureId();
  for (const Disturbances& one : EachAt(1.0)) {
    EXPECT_NE(Draw(one).rgb, clear.rgb);
    EXPECT_NE(view_->TextureId(), texture);
  }
  Disturbances none;
  none.seed = 7;
  none.time = 3.0;
  EXPECT_EQ(Draw(none).rgb, clear.rgb);
  EXPECT_EQ(view_->TextureId(), texture);
  picture_.plain = true;
  const ColourImage plain = Draw({});
  for (const Disturbances& one : EachAt(1.0)) EXPECT_EQ(Draw(one).rgb, plain.rgb);
}

// Reads the texture that a window shows; ReadPixels reads the framebuffer that was drawn into.
ColourImage ReadTexture(unsigned id, int size) {
  ColourImage upside_down(size, size), picture(size, size);
  glBindTexture(GL_TEXTURE_2D, id);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGB, GL_UNSIGNED_BYTE, upside_down.rgb.data());
  glBindTexture(GL_TEXTURE_2D, 0);
  for (int y = 0; y < size; ++y)
    std::copy_n(upside_down.at(0, size - 1 - y), 3 * size, picture.at(0, y));
  return picture;
}

TEST_F(DisturbedView, TheShownTextureHoldsThePictureAfterEachChangeOfSize) {
  ShowJoint();
  std::vector<Disturbances> cases = EachAt(1.0);
  cases.emplace_back();
  for (double Disturbances::*field :
       {&Disturbances::haze, &Disturbances::bubbles, &Disturbances::fog, &Disturbances::near_blur})
    cases.back().*field = 0.5;
  for (const Disturbances& one : cases)
    for (const int size : {256, 192, 320, 256, 16, 256}) {
      const ColourImage picture = Draw(one, size);
      EXPECT_EQ(ReadTexture(view_->TextureId(), size).rgb, picture.rgb) << size;
      const double mean =
          std::accumulate(picture.rgb.begin(), picture.rgb.end(), 0.0) / picture.rgb.size();
      EXPECT_GT(mean, 10.0) << "black at " << size;
    }
}

TEST_F(DisturbedView, IsAFunctionOfSeedAndTime) {
  ShowJoint();
  for (const Disturbances& one : EachAt(1.0)) {
    Disturbances other = one;
    const auto first = Draw(one).rgb;
    other.seed = 5;
    EXPECT_EQ(Draw(other).rgb != first, one.is_moving() || one.fog > 0);
    other = one;
    other.time = 1.7;
    const auto later = Draw(other).rgb;
    EXPECT_EQ(later != first, one.is_moving());
    Draw({});
    EXPECT_EQ(Draw(other).rgb, later);
    EXPECT_EQ(Draw(one).rgb, first);
  }
}

TEST_F(DisturbedView, DistancesDoNotChange) {
  ShowJoint();
  Draw({});
  const std::vector<float> clear = view_->ReadDistances();
  Disturbances all;
  all.haze = all.bubbles = all.debris = all.fog = all.near_blur = all.far_blur = 1;
  Draw(all);
  EXPECT_EQ(view_->ReadDistances(), clear);
}

// Beer-Lambert: over 20 mm at half strength red gains exp(0.5 * (100 - 27) * 0.02) = 2.1 times over
// green at mean density; clouds that differ by half and the veil's own red leave at least 1.5.
TEST_F(DisturbedView, BloodReddensFarPartsMore) {
  Disturbances haze;
  haze.haze = 0.5;
  double last = 0;
  for (const double distance : {5e-3, 15e-3, 35e-3}) {
    ShowWall(Grey(170), distance);
    const ColourImage picture = Draw(haze);
    double red = 0, green = 0;
    for (int y = 64; y < 192; ++y)
      for (int x = 64; x < 192; ++x) {
        red += Light(picture.at(x, y)[0]);
        green += Light(picture.at(x, y)[1]);
      }
    std::printf("haze 0.5, %2.0f mm: red is %.2f times green\n", 1e3 * distance, red / green);
    EXPECT_GT(red / green, distance < 10e-3 ? 1.05 : 1.5 * last);
    last = red / green;
  }
}

// Variance, in px², of the spread of a step from dark to bright along the middle row. A lone step
// of one level is left out: it is a rounding of the even sides, which drivers round differently,
// and far from the edge it would count as much as the edge.
double EdgeVariance(const ColourImage& picture) {
  double sum = 0, mean = 0, square = 0;
  const int y = picture.height / 2, half = picture.width / 4;
  const auto step_at = [&](int x) {
    return double(picture.at(x + 1, y)[1]) - double(picture.at(x, y)[1]);
  };
  for (int x = picture.width / 2 - half; x < picture.width / 2 + half; ++x) {
    const double step = step_at(x);
    if (std::abs(step) <= 1 && step_at(x - 1) == 0 && step_at(x + 1) == 0) continue;
    sum += step;
    mean += step * x;
    square += step * x * x;
  }
  mean /= sum;
  return square / sum - mean * mean;
}

// A disc of diameter c has a standard deviation of c/4 along a line. The boxes of a mipmap have
// fixed places, so the width of an edge depends on its place: the mean over eight places is within
// 15 %.
TEST_F(DisturbedView, ABlurredEdgeIsAsWideAsTheDiscOfConfusion) {
  constexpr int kPixels = 512, kPlaces = 8;
  ColourImage step(1024, 1024);
  const auto check = [&](double Disturbances::*field, double distance) {
    Disturbances blur;
    blur.*field = 0.8;
    double sharp = 0, blurred = 0;
    for (int place = 0; place < kPlaces; ++place) {
      for (int y = 0; y < step.height; ++y)
        for (int x = 0; x < step.width; ++x)
          std::fill_n(step.at(x, y), 3, std::uint8_t(x < step.width / 2 + 3 * place ? 60 : 180));
      ShowWall(step, distance);
      sharp += EdgeVariance(Draw({}, kPixels)) / kPlaces;
      blurred += EdgeVariance(Draw(blur, kPixels)) / kPlaces;
    }
    const double disc = app::BlurDiameter(blur, distance, picture_.field_of_view, kPixels / 2.0);
    const double measured = std::sqrt(blurred), expected = std::sqrt(disc * disc / 16 + sharp);
    std::printf("%s blur, %4.1f mm: disc %5.2f px, spread %5.2f px, expected %5.2f px\n",
                field == &Disturbances::near_blur ? "near" : "far ", 1e3 * distance, disc, measured,
                expected);
    EXPECT_NEAR(measured, expected, 0.15 * expected);
    return disc;
  };
  EXPECT_EQ(check(&Disturbances::far_blur, app::kFarBlurFocus), 0.0);
  EXPECT_GT(check(&Disturbances::far_blur, 12e-3), 3.0);
  EXPECT_GT(check(&Disturbances::far_blur, 40e-3), 10.0);
  EXPECT_EQ(check(&Disturbances::near_blur, app::kNearBlurFocus), 0.0);
  EXPECT_GT(check(&Disturbances::near_blur, 12e-3), 3.0);
  EXPECT_GT(check(&Disturbances::near_blur, 6e-3), 10.0);
}

// A sharp part does not spread into a blurred background, and a blurred part spreads over a sharp
// background.
TEST_F(DisturbedView, OnlyDefocusedPartsSpread) {
  ShowWall(Grey(200), 40e-3);
  picture_.instrument = app::InstrumentView{{0.03, 0, 0.009}, {-0.02, 0, 0.009}, 0.0};
  const auto beside = [&](const Disturbances& blur) {
    // A column of pixels across the darker shaft, and how far it reaches beyond its edge.
    const ColourImage clear = Draw({}), blurred = Draw(blur);
    const std::vector<float> distances = view_->ReadDistances();
    int reached = 0;
    for (int y = 0; y < kDisturbedSize; ++y)
      if (distances[std::size_t(y) * kDisturbedSize + kDisturbedSize / 2] > 0.02f)
        reached +=
            blurred.at(kDisturbedSize / 2, y)[1] + 6 < clear.at(kDisturbedSize / 2, y)[1] ? 1 : 0;
    return reached;
  };
  Disturbances far, near;
  far.far_blur = 1;
  near.near_blur = 1;
  EXPECT_LE(beside(far), 2);  // a pixel on each side
  EXPECT_GE(beside(near), 4);
}

// 8-bit rounding of two greys of about 60 is 2 % of their light.
TEST_F(DisturbedView, OverexposureIsAGainOfLight) {
  ShowWall(Grey(60), 15e-3);
  const ColourImage clear = Draw({});
  for (const double strength : {0.2, 0.5, 1.0}) {
    Disturbances over;
    over.overexposure = strength;
    const ColourImage bright = Draw(over);
    double before = 0, after = 0;
    for (int y = 100; y < 156; ++y)
      for (int x = 100; x < 156; ++x) {
        before += Light(clear.at(x, y)[1]);
        after += Light(bright.at(x, y)[1]);
      }
    std::printf("overexposure %.1f: %.3f times the light, expected %.3f\n", strength,
                after / before, app::ExposureGain(strength));
    EXPECT_NEAR(after / before, app::ExposureGain(strength), 0.03 * app::ExposureGain(strength));
  }
}

TEST_F(DisturbedView, FogGrowsFromTheRimAndReducesContrast) {
  ColourImage checks(512, 512);
  for (int y = 0; y < checks.height; ++y)
    for (int x = 0; x < checks.width; ++x)
      std::fill_n(checks.at(x, y), 3, std::uint8_t((x / 16 + y / 16) % 2 == 0 ? 60 : 180));
  ShowWall(checks, 20e-3);
  const ColourImage clear = Draw({});
  // Mean difference between a pixel and its third neighbour.
  const auto detail = [&](const ColourImage& picture, double inner, double outer) {
    double sum = 0, count = 0;
    for (int y = 0; y < kDisturbedSize; ++y)
      for (int x = 0; x + 3 < kDisturbedSize; ++x) {
        const double r = std::hypot(x - 126.0, y - 127.5) / 128;
        if (r < inner || r > outer) continue;
        sum += std::abs(double(picture.at(x, y)[1]) - double(picture.at(x + 3, y)[1]));
        ++count;
      }
    return sum / count;
  };
  double last = 1;
  for (const double strength : {0.25, 0.5, 1.0}) {
    Disturbances fog;
    fog.fog = strength;
    const ColourImage veiled = Draw(fog);
    const double middle = detail(veiled, 0, 0.3) / detail(clear, 0, 0.3);
    const double rim = detail(veiled, 0.7, 0.93) / detail(clear, 0.7, 0.93);
    std::printf("fog %.2f leaves %.2f of the detail in the middle, %.2f at the rim\n", strength,
                middle, rim);
    EXPECT_LT(rim, last);
    last = rim;
    if (strength < 1.0) {
      EXPECT_LT(rim, middle);
      EXPECT_GT(middle, 0.9 - strength);
    }
  }
  EXPECT_LT(last, 0.2);
}

double DiscArea(const std::vector<app::DriftingBit>& bits, double margin) {
  double area = 0;
  for (const auto& bit : bits) {
    const double r = 0.5 * kDisturbedSize * bit.radius * (1.0 + margin * bit.softness) + margin;
    area += std::numbers::pi * r * r;
  }
  return area;
}

TEST_F(DisturbedView, BubblesChangeThePictureOnlyWhereTheyAre) {
  ShowWall(Grey(120), 40e-3);
  const ColourImage clear = Draw({});
  int last = 0;
  for (const double strength : {0.1, 0.4, 1.0}) {
    Disturbances air;
    air.bubbles = strength;
    const auto bits = app::Bubbles(air, picture_.view, picture_.field_of_view);
    const ColourImage picture = Draw(air);
    const auto [changed, elsewhere] = ChangedBetween(clear, picture, [&](const glm::dvec2& at) {
      return std::ranges::any_of(bits, [&](const app::DriftingBit& bit) {
        return glm::distance(at, bit.centre) < bit.radius * (1 + 1.0 * bit.softness) + 0.02;
      });
    });
    std::printf("bubbles %.1f: %d of %d in sight, %d px changed, discs of %.0f px\n", strength,
                int(bits.size()), app::BubbleCount(strength), changed, DiscArea(bits, 0));
    EXPECT_EQ(elsewhere, 0);
    EXPECT_GT(changed, last);
    EXPECT_LE(changed, DiscArea(bits, 1.0));
    // Some overlap, fade in or reach out of the window.
    EXPECT_GE(changed, 0.4 * DiscArea(bits, 0));
    last = changed;
  }
  EXPECT_EQ(app::BubbleCount(0), 0);
  EXPECT_EQ(app::BubbleCount(0.01), 1);
  EXPECT_EQ(app::BubbleCount(1), app::kMostBubbles);
}

TEST_F(DisturbedView, DebrisBehindTheProbeIsHidden) {
  ShowWall(Grey(60), 40e-3);
  // A shaft across the window, 4 mm in front of the lens.
  const app::InstrumentView shaft{{0.03, 0, 0.006}, {-0.03, 0, 0.006}, 0.0};
  Disturbances debris;
  debris.debris = 1;
  int hidden = 0, seen_without = 0;
  for (debris.seed = 0; debris.seed < 4; ++debris.seed) {
    picture_.instrument.reset();
    const ColourImage bare = Draw({}), bare_dirty = Draw(debris);
    picture_.instrument = shaft;
    const ColourImage clear = Draw({}), dirty = Draw(debris);
    const std::vector<float> distances = view_->ReadDistances();
    const auto flakes = app::Flakes(debris, picture_.view, picture_.field_of_view);
    const auto is_over = [&](const glm::dvec2& at, const app::DriftingBit& flake) {
      return glm::distance(at, flake.centre) < flake.radius * 1.5 * (1.0 + flake.softness);
    };
    for (int y = 0; y < kDisturbedSize; ++y)
      for (int x = 0; x < kDisturbedSize; ++x) {
        const float distance = distances[std::size_t(y) * kDisturbedSize + x];
        const glm::dvec2 at((x + 0.5) / (0.5 * kDisturbedSize) - 1.0,
                            1.0 - (y + 0.5) / (0.5 * kDisturbedSize));
        if (distance <= 0.0f || distance > 0.03f ||
            std::ranges::any_of(flakes, [&](const auto& flake) {
              return flake.distance < distance && is_over(at, flake);
            }))
          continue;
        EXPECT_TRUE(std::equal(dirty.at(x, y), dirty.at(x, y) + 3, clear.at(x, y)));
        ++hidden;
        seen_without += std::equal(bare.at(x, y), bare.at(x, y) + 3, bare_dirty.at(x, y)) ? 0 : 1;
      }
  }
  std::printf(
      "debris: %d px of the shaft with nothing before them, %d of them with debris behind\n",
      hidden, seen_without);
  EXPECT_GT(seen_without, 50);
}

TEST_F(DisturbedView, AnInvalidStrengthIsRefusedInOneSentence) {
  ShowJoint();
  const auto refuse = [&](const std::function<void()>& act, const std::string& word) {
    try {
      act();
      ADD_FAILURE() << "not refused: " << word;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  for (const double wrong : {-1.0, 7.0, double(NAN), double(INFINITY)}) {
    for (const Disturbances& one : EachAt(wrong)) refuse([&] { Draw(one); }, "between 0 and 1");
    Disturbances late;
    late.time = wrong;
    if (!std::isfinite(wrong)) refuse([&] { Draw(late); }, "seconds");
  }
  refuse([] { simulation::ParseDisturbances("haze=0.5,smoke=1"); },
         "there are haze, bubbles, debris");
  refuse([] { simulation::ParseDisturbances("haze=0.5,haze=1"); }, "haze");
  refuse([] { simulation::ParseDisturbances("haze=7"); }, "between 0 and 1");
  refuse([] { simulation::ParseDisturbances("haze=nan"); }, "between 0 and 1");
  refuse([] { simulation::ParseDisturbances("haze=0.5x"); }, "between 0 and 1");
  refuse([] { simulation::ParseDisturbances("haze"); }, "name=strength");
  refuse([] { simulation::ParseDisturbances(""); }, "name=strength");
  const Disturbances read = simulation::ParseDisturbances("fog=0.25,near_blur=1,haze=0");
  EXPECT_EQ(read.fog, 0.25);
  EXPECT_EQ(read.near_blur, 1.0);
  EXPECT_EQ(read.haze + read.bubbles + read.debris, 0.0);
}

// Flakes keep their places in the joint while the scope moves past them: parallax.
TEST(DriftingBits, ShowParallaxWhenTheScopeMoves) {
  Disturbances debris;
  debris.debris = 1;
  const auto here = PictureFromPose({0, 0, 0, 0.010}, 0.0, 1.4).view;
  auto there = here;
  there.tip += 0.3e-3 * here.right;
  const auto before = app::Flakes(debris, here, 1.4), after = app::Flakes(debris, there, 1.4);
  int moved = 0;
  for (const auto& a : before)
    for (const auto& b : after)
      if (a.shape == b.shape && glm::length(a.centre) < 0.5) {
        ++moved;
        // To first order the displacement in the window equals that on the flake's own sphere.
        const double expected = -0.3e-3 / a.distance / (2.0 * std::sin(1.4 / 4.0));
        EXPECT_NEAR(b.centre.x - a.centre.x, expected, 0.2 * std::abs(expected));
      }
  EXPECT_GT(moved, 3);
  // Bubbles on the lens keep their places in the picture's own frame.
  Disturbances air;
  air.bubbles = 1;
  int stuck = 0;
  for (const auto& a : app::Bubbles(air, here, 1.4))
    for (const auto& b : app::Bubbles(air, there, 1.4))
      stuck += a.shape == b.shape && a.centre == b.centre ? 1 : 0;
  EXPECT_EQ(stuck, app::kMostBubbles / 4);
}

double CpuMilliseconds(const std::function<void()>& frame) {
  double least = 1e9;
  for (int batch = 0; batch < 2; ++batch) {
    const std::clock_t start = std::clock();
    for (int i = 0; i < 3; ++i) frame();
    least = std::min(least, 1e3 * double(std::clock() - start) / CLOCKS_PER_SEC / 3);
  }
  return least;
}

// Processor time of the process, with llvmpipe's threads. No disturbance takes more than twice the
// time of the picture; all together take at most four times.
TEST_F(DisturbedView, TakesLessThanTwiceTheTimeOfThePicture) {
  ShowJoint();
  picture_.instrument = ProbeInFront();
  Disturbances all = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
  for (const int size : {512, 1024}) {
    const auto cost = [&](Disturbances what) {
      Draw(what, size);  // compiles
      return CpuMilliseconds([&] {
        what.time += 0.04;
        Draw(what, size);
      });
    };
    const double clear = cost({});
    std::printf("%4d px: %.1f ms of processor time per frame;", size, clear);
    const char* names[] = {"haze", "bubbles", "debris", "fog", "near blur", "far blur", "over"};
    const char* const* name = names;
    for (const Disturbances& one : EachAt(0.5)) {
      const double with = cost(one);
      std::printf(" %s %+.1f,", *name++, with - clear);
      EXPECT_LT(with, 3.0 * clear);
    }
    const double with = cost(all);
    std::printf(" all %+.1f\n", with - clear);
    EXPECT_LT(with, 5.0 * clear);
  }
}

}  // namespace
}  // namespace arthro::test
