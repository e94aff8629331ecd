#include "app/recording/live_film.h"

#include <chrono>
#include <cmath>
#include <csignal>
#include <sys/resource.h>
#include <thread>

#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "tests/support/film_frames.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

const FilmForm kForm{FrameShape::k4x3, 120, 25.0};

ColourImage Grey(int level, int size = 200) {
  ColourImage picture(size, size);
  std::fill(picture.rgb.begin(), picture.rgb.end(), static_cast<std::uint8_t>(level));
  return picture;
}

// At least ten minutes: a machine may be busy, a film that hangs must not.
void WaitForEnd(const LiveFilm& film) {
  for (int i = 0; i < 120000 && !film.HasEnded(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_TRUE(film.HasEnded());
}

// The grey in the middle of each frame.
std::vector<int> Levels(const std::filesystem::path& file) {
  const auto [info, frames] = test::ReadFilm(file);
  EXPECT_EQ(info.width, 160);
  EXPECT_EQ(info.height, 120);
  std::vector<int> levels;
  for (const cv::Mat& rgb : frames) levels.push_back(rgb.at<cv::Vec3b>(60, 80)[1]);
  return levels;
}

// A level of grey survives the codec to within 3 of 255 (its range is 219 steps, and it quantises);
// the levels here are 40 apart.
TEST(LiveFilm, APictureStandsUntilTheNextOnesTime) {
  const test::TempFolder folder;
  LiveFilm film(folder / "film.mp4", kForm);
  film.Offer(0.0, Grey(40));
  EXPECT_FALSE(film.IsDue(0.01)) << "of the same frame";
  film.Offer(0.01, Grey(240));
  film.Offer(0.21, Grey(80, 300));  // frame 5: the window was slow
  film.Offer(0.25, Grey(120, 64));
  film.End(0.5);
  WaitForEnd(film);
  EXPECT_EQ(film.fault(), "");
  EXPECT_EQ(film.left_out(), 0);
  const std::vector<int> levels = Levels(folder / "film.mp4");
  ASSERT_EQ(levels.size(), 12u) << "half a second, 12.5 frames";
  for (std::size_t i = 0; i < levels.size(); ++i)
    EXPECT_NEAR(levels[i], i < 5 ? 40 : i < 6 ? 80 : 120, 3) << i;
}

TEST(LiveFilm, WhatDoesNotFitIsLeftOutAndTheFilmKeepsItsLength) {
  const test::TempFolder folder;
  // Full film size: encoding a picture takes tens of milliseconds, offering one takes none.
  LiveFilm film(folder / "film.mp4", {FrameShape::k16x9, 2160, 25.0});
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 30; ++i) film.Offer(i / 25.0, Grey(40 + i, 64));
  const double offering =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const int left_out = film.left_out();
  // Had an offer waited for the encoder, none would have been left out.
  EXPECT_GT(left_out, 0);
  EXPECT_GE(30 - left_out, static_cast<int>(LiveFilm::kQueue));
  film.End(30 / 25.0);
  WaitForEnd(film);
  EXPECT_EQ(film.fault(), "");
  EXPECT_EQ(authoring::Footage::Open(folder / "film.mp4").info().frames, 30);
  std::printf("30 pictures offered in %.1f ms, %d left out\n", 1e3 * offering, left_out);
}

TEST(LiveFilm, AFaultEndsItWithASentenceAndLeavesNothing) {
  const test::TempFolder folder;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &usual), 0);
  LiveFilm film(folder / "film.mp4", kForm);
  rlimit small = usual;
  small.rlim_cur = 500;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  for (int i = 0; i < 8; ++i) film.Offer(i / 25.0, Grey(30 * i));
  film.End(8 / 25.0);
  WaitForEnd(film);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &usual), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(film.fault().find("this film was not written"), std::string::npos) << film.fault();
  film.Offer(1.0, Grey(0));  // later pictures are ignored, without a fault
  EXPECT_FALSE(std::filesystem::exists(folder / "film.mp4"));
}

TEST(LiveFilm, OneThatIsDroppedIsWrittenAndOneWithoutAPictureIsNot) {
  const test::TempFolder folder;
  {
    LiveFilm film(folder / "film.mp4", kForm);
    film.Offer(0.0, Grey(100));
    film.Offer(0.04, Grey(100));
    LiveFilm empty(folder / "empty.mp4", kForm);
    empty.End(1.0);
    WaitForEnd(empty);
    EXPECT_NE(empty.fault().find("no picture"), std::string::npos) << empty.fault();
  }
  EXPECT_EQ(Levels(folder / "film.mp4").size(), 2u);
  EXPECT_FALSE(std::filesystem::exists(folder / "empty.mp4"));
  EXPECT_THROW(LiveFilm(folder / "no" / "film.mp4", kForm), Error);
}

}  // namespace
}  // namespace arthro::app
