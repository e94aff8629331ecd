// Films written and read back by the decoder that reads footage.
#include "app/recording/video_file.h"

#include <cmath>
#include <csignal>
#include <fstream>
#include <sched.h>
#include <sys/resource.h>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/film_frames.h"
#include "tests/support/knee_picture.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

constexpr VideoSize kSize = {160, 120};

// The knee with a bar that tells which frame it is.
ColourImage Frame(int index) {
  ColourImage picture = test::KneePicture(kSize.width, kSize.height);
  for (int y = 20; y < 100; ++y)
    for (int x = 6 * index; x < 6 * index + 6; ++x)
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = 240;
  return picture;
}

std::string SentenceOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class Films : public testing::TestWithParam<const char*> {};

// 33 dB is a mean error of 4 of 255: half of the knee's grain (sd 3) and the rounding of film's
// narrower range together stay below it, a wrong frame does not (the bar alone: 25 dB).
TEST_P(Films, AreReadBackWithTheirFramesInOrder) {
  const test::TempFolder folder;
  const auto file = folder / (std::string("film") + GetParam());
  constexpr int kCount = 20;
  VideoFile film(file, kSize, 25.0);
  for (int i = 0; i < kCount; ++i) film.Add(Frame(i));
  EXPECT_EQ(film.count(), kCount);
  film.Finish();
  EXPECT_EQ(test::FileCount(folder.path()), 1);

  const auto [info, frames] = test::ReadFilm(file);
  EXPECT_EQ(info.width, kSize.width);
  EXPECT_EQ(info.height, kSize.height);
  EXPECT_EQ(info.frames, kCount);
  EXPECT_NEAR(info.frames_per_second, 25.0, 1e-6);
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(kCount));
  double worst = 1e9;
  for (int i = 0; i < kCount; ++i) {
    const cv::Mat& rgb = frames[static_cast<std::size_t>(i)];
    const double own = test::LumaPsnr(rgb, Frame(i));
    worst = std::min(worst, own);
    EXPECT_GT(own, 33.0) << i;
    for (const int other : {i - 1, i + 1})
      if (other >= 0 && other < kCount) {
        EXPECT_LT(test::LumaPsnr(rgb, Frame(other)), own - 3.0) << i;
      }
  }
  std::printf("%s: worst frame %.1f dB\n", GetParam(), worst);
}

TEST_P(Films, TheSamePicturesGiveTheSameBytes) {
  const test::TempFolder folder;
  std::string bytes[2];
  for (std::string& of : bytes) {
    const auto file = folder / (std::string("film") + GetParam());
    VideoFile film(file, kSize, 30.0);
    for (int i = 0; i < 12; ++i) film.Add(Frame(i));
    film.Finish();
    of = ReadWholeFile(file);
  }
  EXPECT_GT(bytes[0].size(), 1000u);
  EXPECT_TRUE(bytes[0] == bytes[1]);
}

// High enough that the film is encoded in several slices.
TEST_P(Films, HaveTheSameBytesOnOneCoreAndOnAll) {
  const test::TempFolder folder;
  cpu_set_t all, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
  CPU_ZERO(&one);
  for (int i = 0; i < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++i)
    if (CPU_ISSET(i, &all)) CPU_SET(i, &one);
  std::string bytes[2];
  for (const bool is_one : {true, false}) {
    ASSERT_EQ(sched_setaffinity(0, sizeof one, is_one ? &one : &all), 0);
    const auto file = folder / (std::string("film") + GetParam());
    VideoFile film(file, {640, 720}, 30.0);
    for (int i = 0; i < 4; ++i) film.Add(test::KneePicture(640, 720, 6.0 + i));
    film.Finish();
    bytes[is_one] = ReadWholeFile(file);
  }
  EXPECT_TRUE(bytes[0] == bytes[1]);
}

TEST_P(Films, MayBeReadByTheirOwnerAlone) {
  const test::TempFolder folder;
  const auto file = folder / (std::string("film") + GetParam());
  const auto mode = [](const std::filesystem::path& of) {
    return static_cast<int>(std::filesystem::status(of).permissions());
  };
  VideoFile film(file, kSize, 30.0);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_EQ(mode(entry.path()), 0600) << entry.path();
  film.Add(Frame(0));
  film.Finish();
  EXPECT_EQ(mode(file), 0600);
}

// RLIMIT_FSIZE stands in for a disk that fills up, from nothing on it to all but the last byte.
// The part that was whole by then is kept beside the old film.
TEST_P(Films, ADiskThatFillsUpIsToldAndLeavesTheOldFilm) {
  const test::TempFolder folder;
  const auto file = folder / (std::string("film") + GetParam());
  const auto write = [&] {
    VideoFile film(file, kSize, 30.0);
    for (int i = 0; i < 12; ++i) film.Add(Frame(i));
    film.Finish();
  };
  write();
  const auto whole = static_cast<rlim_t>(std::filesystem::file_size(file));
  std::ofstream(file, std::ios::trunc) << "an older film";
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &usual), 0);
  const std::string why = "no more may be written here";
  for (const rlim_t room : {rlim_t{0}, rlim_t{1000}, whole / 2, whole - 600, whole - 1}) {
    rlimit small = usual;
    small.rlim_cur = room;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const std::string said = SentenceOf(write);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &usual), 0);
    EXPECT_NE(said.find("this film was not written"), std::string::npos) << room << ": " << said;
    EXPECT_NE(said.find(why), std::string::npos) << room << ": " << said;
    EXPECT_TRUE(ReadWholeFile(file) == "an older film") << room;
    const auto kept = folder / (std::string("film-recovered") + GetParam());
    const bool is_kept = std::filesystem::exists(kept);
    EXPECT_EQ(test::FileCount(folder.path()), is_kept ? 2 : 1) << room;
    if (!is_kept) continue;
    EXPECT_NE(said.find("its first 0.4 s are in " + kept.string()), std::string::npos) << said;
    EXPECT_EQ(test::ReadFilm(kept).frames.size(), 12u) << room;
    std::filesystem::remove(kept);
  }
  std::signal(SIGXFSZ, handler);
}

TEST_P(Films, ThatADiskCutsShortKeepWhatWasWhole) {
  const test::TempFolder folder;
  const auto file = folder / (std::string("film") + GetParam());
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &usual), 0);
  int count = 0;
  const std::string said = SentenceOf([&] {
    VideoFile film(file, kSize, 20.0);
    rlimit small = usual;
    small.rlim_cur = 120'000;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    for (; count < 2000; ++count) film.Add(Frame(count % 26));
  });
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &usual), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(said.find("this film was not written to its end"), std::string::npos) << said;
  EXPECT_NE(said.find("no more may be written here"), std::string::npos) << said;
  EXPECT_NE(said.find("s are in " + file.string()), std::string::npos) << said;
  EXPECT_EQ(test::FileCount(folder.path()), 1);
  const auto frames = test::ReadFilm(file).frames;
  // Half a second is 10 pictures.
  EXPECT_GE(static_cast<int>(frames.size()), count - 10);
  EXPECT_GT(frames.size(), 0u);
  for (std::size_t i = 0; i < frames.size(); ++i)
    EXPECT_GT(test::LumaPsnr(frames[i], Frame(static_cast<int>(i) % 26)), 33.0) << i;
}

INSTANTIATE_TEST_SUITE_P(Endings, Films, testing::Values(".mp4", ".mkv", ".avi"),
                         [](const auto& one) { return std::string(one.param + 1); });

TEST(VideoFile, WhatCannotBeAFilmIsRefusedInASentence) {
  const test::TempFolder folder;
  const auto film = [&](const std::string& name, VideoSize size, double rate) {
    return SentenceOf([&] { VideoFile(folder / name, size, rate); });
  };
  EXPECT_NE(film("film.gif", kSize, 30).find("name it .mp4, .mkv or .avi"), std::string::npos);
  EXPECT_NE(film("film", kSize, 30).find("name it .mp4"), std::string::npos);
  for (const VideoSize size :
       {VideoSize{0, 120}, {161, 120}, {160, 121}, {8, 8}, {-2, 120}, {9000, 120}})
    EXPECT_NE(film("film.mp4", size, 30).find("both sides must be even"), std::string::npos)
        << size.width << "x" << size.height;
  for (const double rate : {0.0, -1.0, 1000.0, std::nan("")})
    EXPECT_NE(film("film.mp4", kSize, rate).find("pictures a second"), std::string::npos) << rate;
  EXPECT_NE(film("no/film.mp4", kSize, 30).find("does not exist"), std::string::npos);
  std::filesystem::create_directory(folder / "here.mp4");
  EXPECT_NE(film("here.mp4", kSize, 30).find("this is a folder"), std::string::npos);
  EXPECT_EQ(test::FileCount(folder.path()), 1);
}

TEST(VideoFile, WhatIsNotFinishedLeavesNothing) {
  const test::TempFolder folder;
  {
    VideoFile film(folder / "film.MP4", kSize, 30.0);
    film.Add(Frame(0));
    EXPECT_NE(SentenceOf([&] { film.Add(ColourImage(2, 2)); }).find("give all one size"),
              std::string::npos);
  }
  EXPECT_EQ(test::FileCount(folder.path()), 0);
  VideoFile empty(folder / "film.mp4", kSize, 30.0);
  EXPECT_NE(SentenceOf([&] { empty.Finish(); }).find("no picture"), std::string::npos);
}

}  // namespace
}  // namespace arthro::app
