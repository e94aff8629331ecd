// Recordings as numbered pictures: whole, or marked as what they are.
#include "app/recording/picture_sequence.h"

#include <csignal>
#include <fstream>
#include <sys/resource.h>

#include <gtest/gtest.h>

#include "app/recording/live_film.h"
#include "simulation/core/error.h"
#include "simulation/scene/image_io.h"
#include "tests/support/knee_picture.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

std::string RefusalOf(const fs::path& target) {
  try {
    CheckFilm(target, {});
  } catch (const Error& error) {
    return error.sentence();
  }
  return "";
}

TEST(PictureSequence, NamesAreAFoldersOrAPatternsOrNone) {
  const test::TempFolder folder;
  const auto of_folder = PictureNamesOf(folder / "new/");
  ASSERT_TRUE(of_folder);
  EXPECT_EQ(of_folder->At(7), folder / "new" / "frame_00007.png");
  EXPECT_EQ(PictureNamesOf(folder.path())->At(0), folder / "frame_00000.png") << "it is there";
  const auto of_pattern = PictureNamesOf("a/shot-%03d of the knee.png");
  ASSERT_TRUE(of_pattern);
  EXPECT_EQ(of_pattern->At(12), fs::path("a/shot-012 of the knee.png"));
  EXPECT_EQ(of_pattern->At(12345), fs::path("a/shot-12345 of the knee.png"));
  EXPECT_FALSE(PictureNamesOf("a/film.mp4"));
  EXPECT_FALSE(PictureNamesOf("a/film"));
  for (const char* name : {"frame.png", "frame-%d.png", "%04d-%04d.png", "frame-%s.png"})
    EXPECT_THROW(PictureNamesOf(name), Error) << name;
}

TEST(PictureSequence, PicturesAreTheOnesThatWereGivenAndTheMarkGoesWhenAllAreThere) {
  const test::TempFolder folder;
  PictureSequence sequence(*PictureNamesOf(folder / "new" / "frame-%02d.png"));
  const fs::path mark = folder / "new" / PictureSequence::kIncomplete;
  const ColourImage knee = test::KneePicture(64, 48);
  ColourImage other = knee;
  other.at(3, 4)[0] ^= 0xFF;
  for (const ColourImage* picture : {&knee, &knee, static_cast<const ColourImage*>(&other), &knee})
    sequence.Add(*picture);
  EXPECT_TRUE(fs::exists(mark));
  EXPECT_EQ(sequence.count(), 4);
  sequence.Finish();
  EXPECT_FALSE(fs::exists(mark));
  EXPECT_EQ(test::FileCount(folder / "new"), 4);
  for (const int i : {0, 1, 3})
    EXPECT_EQ(ReadColourImage(folder / "new" / ("frame-0" + std::to_string(i) + ".png")).rgb,
              knee.rgb);
  EXPECT_EQ(ReadColourImage(folder / "new" / "frame-02.png").rgb, other.rgb);
}

TEST(PictureSequence, OneWithoutAPictureLeavesNothing) {
  const test::TempFolder folder;
  PictureSequence sequence(*PictureNamesOf(folder / "new/"));
  EXPECT_THROW(sequence.Finish(), Error);
  EXPECT_FALSE(fs::exists(folder / "new"));
}

TEST(PictureSequence, AFolderWithSomethingInItIsRefusedAndKept) {
  const test::TempFolder folder;
  std::ofstream(folder / "notes.txt") << "mine";
  EXPECT_NE(RefusalOf(folder.path()).find("not empty"), std::string::npos);
  EXPECT_NE(RefusalOf(folder / "frame-%04d.png").find("not empty"), std::string::npos);
  EXPECT_NE(RefusalOf(folder / "no" / "new/").find("does not exist"), std::string::npos);
  EXPECT_NE(RefusalOf(folder / "notes.txt" / "frame-%04d.png").find("this is a file"),
            std::string::npos);
  EXPECT_NE(RefusalOf(folder / "frame.png").find("frame-%04d.png"), std::string::npos);
  EXPECT_EQ(RefusalOf(folder / "new/"), "");
  EXPECT_EQ(test::FileCount(folder.path()), 1) << "looking made nothing";
  EXPECT_THROW(PictureSequence(*PictureNamesOf(folder.path())), Error);
  EXPECT_EQ(test::FileCount(folder.path()), 1);
}

// Timing of a live film: a picture stands until the time of the next one.
TEST(LivePictures, AreAsManyAsAFilmsFramesAndExact) {
  const test::TempFolder folder;
  {
    LiveFilm film((folder / "new/").string(), {FrameShape::kSquare, 48, 25.0});
    EXPECT_TRUE(film.is_pictures());
    film.Offer(0.0, test::KneePicture(48, 48));
    film.Offer(0.13, ColourImage(48, 48));  // frame 3
    film.End(0.2);
  }
  EXPECT_EQ(test::FileCount(folder / "new"), 5);
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(ReadColourImage(folder / "new" / ("frame_0000" + std::to_string(i) + ".png")).rgb,
              i < 3 ? test::KneePicture(48, 48).rgb : ColourImage(48, 48).rgb)
        << i;
}

TEST(LivePictures, ADiskThatIsFullKeepsWhatIsThereAndTheMark) {
  const test::TempFolder folder;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &usual), 0);
  std::string fault;
  {
    LiveFilm film((folder / "new/").string(), {FrameShape::kSquare, 96, 25.0});
    film.Offer(0.0, ColourImage(96, 96));  // black packs well
    rlimit small = usual;
    small.rlim_cur = 1000;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    film.Offer(0.04, test::KneePicture(96, 96));
    film.End(0.08);
    while (!film.HasEnded()) std::this_thread::yield();
    fault = film.fault();
  }
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &usual), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(fault.find("this picture was not written: no more may be written here"),
            std::string::npos)
      << fault;
  EXPECT_TRUE(fs::exists(folder / "new" / PictureSequence::kIncomplete));
  EXPECT_EQ(ReadColourImage(folder / "new" / "frame_00000.png").rgb, ColourImage(96, 96).rgb);
}

}  // namespace
}  // namespace arthro::app
