#include "authoring/footage/footage.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "authoring/footage/picture_list.h"
#include "authoring/footage/video_container.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

void WritePicture(const fs::path& file, int grey, int type = CV_8UC3, cv::Size size = {24, 16}) {
  ASSERT_TRUE(cv::imwrite(file.string(), cv::Mat(size, type, cv::Scalar::all(grey))));
}

// Grey level of each frame as read back; -1 for an unreadable frame.
std::vector<int> LevelsOf(Footage& footage) {
  std::vector<int> levels;
  cv::Mat rgb;
  while (footage.Next(rgb)) levels.push_back(rgb.empty() ? -1 : rgb.at<cv::Vec3b>(1, 1)[1]);
  return levels;
}

std::string SentenceOf(const fs::path& path) {
  try {
    Footage::Open(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// A motion-JPEG clip, which OpenCV writes and reads without a codec of the machine.
void WriteVideo(const fs::path& file, int frames) {
  cv::VideoWriter writer(file.string(), cv::CAP_OPENCV_MJPEG,
                         cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25.0, {64, 48});
  ASSERT_TRUE(writer.isOpened());
  for (int i = 0; i < frames; ++i) {
    cv::Mat frame(48, 64, CV_8UC3, cv::Scalar(200, 100, 10.0 * i));  // BGR
    writer.write(frame);
  }
}

TEST(Footage, FolderIsReadInTheOrderOfItsNumbers) {
  const test::TempFolder folder;
  WritePicture(folder / "f10.png", 100);
  WritePicture(folder / "f2.png", 20);
  WritePicture(folder / "f1.jpg", 10);
  WritePicture(folder / ".hidden.png", 250);
  WriteAtomically(folder / "gt.json", "{}");
  Footage footage = Footage::Open(folder.path());
  EXPECT_EQ(footage.info().frames, 3);
  EXPECT_EQ(footage.info().width, 24);
  EXPECT_EQ(footage.info().height, 16);
  EXPECT_FALSE(footage.info().is_video);
  EXPECT_EQ(LevelsOf(footage), (std::vector<int>{10, 20, 100}));
  EXPECT_EQ(footage.NameOf(2), "f10.png");
  footage.Rewind();
  ASSERT_TRUE(footage.Skip());
  EXPECT_EQ(LevelsOf(footage), (std::vector<int>{20, 100}));
}

TEST(Footage, NamesAreInNaturalOrder) {
  EXPECT_TRUE(ComesBefore("f2", "f10"));
  EXPECT_TRUE(ComesBefore("f9z", "f10a"));
  EXPECT_TRUE(ComesBefore("a1b2", "a1b10"));
  EXPECT_TRUE(ComesBefore("1", "01") != ComesBefore("01", "1"));
  EXPECT_FALSE(ComesBefore("f2", "f2"));
  EXPECT_TRUE(ComesBefore("f", "f1"));
  EXPECT_TRUE(ComesBefore("99999999999999999998", "99999999999999999999"));
}

TEST(Footage, PatternTakesWhatPrintfWouldWrite) {
  const test::TempFolder folder;
  for (const int i : {7, 8, 10, 123}) WritePicture(folder / fmt::format("{:02}.png", i), i);
  WritePicture(folder / "007.png", 200);
  WritePicture(folder / "x08.png", 200);
  Footage footage = Footage::Open(folder / "%02d.png");
  EXPECT_EQ(LevelsOf(footage), (std::vector<int>{7, 8, 10, 123}));
  EXPECT_NE(SentenceOf(folder / "%d_%d.png").find("one number"), std::string::npos);
  EXPECT_NE(SentenceOf(folder / "y%d.png").find("no file has a name of this pattern"),
            std::string::npos);
}

// PAN-13.
TEST(Footage, GreyAlphaAnd16BitBecomeRgb) {
  const test::TempFolder folder;
  WritePicture(folder / "1.png", 90, CV_8UC1);
  WritePicture(folder / "2.png", 90, CV_8UC4);
  WritePicture(folder / "3.png", 90 * 257, CV_16UC1);
  WritePicture(folder / "4.png", 90 * 257, CV_16UC3);
  ASSERT_TRUE(cv::imwrite((folder / "5.png").string(),
                          cv::Mat(16, 24, CV_8UC3, cv::Scalar(10, 90, 200))));  // BGR
  Footage footage = Footage::Open(folder.path());
  EXPECT_EQ(LevelsOf(footage), (std::vector<int>{90, 90, 90, 90, 90}));
  footage.Rewind();
  cv::Mat rgb;
  while (footage.Next(rgb)) {
    EXPECT_EQ(rgb.type(), CV_8UC3);
    if (footage.index() == 4) {
      EXPECT_EQ(rgb.at<cv::Vec3b>(0, 0), cv::Vec3b(200, 90, 10));
    }
  }
}

// PAN-13.
TEST(Footage, AnUnreadableFrameIsNamedAndTheOthersCome) {
  const test::TempFolder folder;
  WritePicture(folder / "1.png", 10);
  WritePicture(folder / "2.png", 20);
  WritePicture(folder / "3.png", 30, CV_8UC3, {40, 30});
  const std::string bytes = ReadWholeFile(folder / "2.png");
  WriteAtomically(folder / "2.png", bytes.substr(0, bytes.size() / 2));
  Footage footage = Footage::Open(folder.path());
  cv::Mat rgb;
  ASSERT_TRUE(footage.Next(rgb));
  EXPECT_EQ(footage.fault(), "");
  ASSERT_TRUE(footage.Next(rgb));
  EXPECT_TRUE(rgb.empty());
  EXPECT_NE(footage.fault().find("cut off"), std::string::npos) << footage.fault();
  EXPECT_EQ(footage.NameOf(footage.index()), "2.png");
  ASSERT_TRUE(footage.Next(rgb));
  EXPECT_EQ(rgb.size(), cv::Size(40, 30));  // another size is reported, not refused
  EXPECT_FALSE(footage.Next(rgb));
  EXPECT_FALSE(footage.Next(rgb));
}

TEST(Footage, VideoComesAsRgbAndTwice) {
  const test::TempFolder folder;
  WriteVideo(folder / "clip.avi", 12);
  Footage footage = Footage::Open(folder / "clip.avi");
  EXPECT_TRUE(footage.info().is_video);
  EXPECT_EQ(footage.info().width, 64);
  EXPECT_NEAR(footage.info().frames_per_second, 25.0, 0.01);
  for (int pass = 0; pass < 2; ++pass) {
    cv::Mat rgb;
    int frames = 0;
    while (footage.Next(rgb)) {
      const cv::Vec3b pixel = rgb.at<cv::Vec3b>(20, 30);
      EXPECT_NEAR(pixel[0], 10 * frames, 6) << frames;  // JPEG of flat colour, chroma subsampled
      EXPECT_NEAR(pixel[2], 200, 6) << frames;
      EXPECT_EQ(footage.index(), frames++);
    }
    EXPECT_EQ(frames, 12);
    EXPECT_EQ(footage.CutShort(), "");
    footage.Rewind();
  }
}

// PAN-13.
TEST(Footage, ATruncatedVideoGivesItsBeginningOrASentence) {
  const test::TempFolder folder;
  WriteVideo(folder / "clip.avi", 40);
  const std::string bytes = ReadWholeFile(folder / "clip.avi");
  WriteAtomically(folder / "half.avi", bytes.substr(0, bytes.size() / 2));
  WriteAtomically(folder / "head.avi", bytes.substr(0, 100));
  Footage footage = Footage::Open(folder / "half.avi");
  const auto levels = LevelsOf(footage);
  EXPECT_GT(levels.size(), 10u);
  EXPECT_LT(levels.size(), 30u);
  if (footage.info().frames > 0) {
    EXPECT_NE(footage.CutShort().find("cut off"), std::string::npos) << footage.info().frames;
  }
  EXPECT_NE(SentenceOf(folder / "head.avi").find("head.avi"), std::string::npos);
}

TEST(Footage, RefusesInOneSentenceWhatIsNoFootage) {
  const test::TempFolder folder;
  EXPECT_NE(SentenceOf(folder / "none.mp4").find("no such file"), std::string::npos);
  EXPECT_NE(SentenceOf(folder.path()).find("folder is empty"), std::string::npos);
  WriteAtomically(folder / "notes.txt", "hello");
  EXPECT_NE(SentenceOf(folder.path()).find("notes.txt"), std::string::npos);
  EXPECT_NE(SentenceOf(folder / "notes.txt").find("cannot be opened"), std::string::npos);
  WriteAtomically(folder / "empty.mp4", "");
  EXPECT_NE(SentenceOf(folder / "empty.mp4").find("0 bytes"), std::string::npos);
  WriteAtomically(folder / "broken.png", "not a picture");
  EXPECT_NE(SentenceOf(folder.path()).find("none of its pictures"), std::string::npos);
  EXPECT_NE(SentenceOf(folder / "broken.png").find("broken.png"), std::string::npos);
  EXPECT_NE(SentenceOf("").find("no such file"), std::string::npos);
}

// One frame of 16000 x 16000 pixels took 3 GB.
TEST(Footage, RefusesFramesThatAreTooLarge) {
  const test::TempFolder folder;
  constexpr std::size_t kSide = 8200;
  WriteAtomically(folder / "huge.y4m", "YUV4MPEG2 W8200 H8200 F25:1 Ip A1:1 C420jpeg\nFRAME\n" +
                                           std::string(kSide * kSide * 3 / 2, '\x80'));
  EXPECT_NE(SentenceOf(folder / "huge.y4m").find("8200 x 8200 pixels; at most 8192 x 8192"),
            std::string::npos)
      << SentenceOf(folder / "huge.y4m");
}

// The decoder would open the files of the list, so the list is refused before.
TEST(Footage, AListOfOtherFilesIsRefusedWhateverItIsCalled) {
  const test::TempFolder folder;
  WriteVideo(folder / "clip.avi", 20);
  const std::string clip = (folder / "clip.avi").string();
  for (const std::string& list :
       {"#EXTM3U\n#EXT-X-TARGETDURATION:9\n#EXTINF:9,\n" + clip + "\n#EXT-X-ENDLIST\n",
        "ffconcat version 1.0\nfile '" + clip + "'\n",
        std::string("v=0\nc=IN IP4 127.0.0.1\nm=video 9 RTP/AVP 96\n"),
        std::string("<?xml version=\"1.0\"?><MPD xmlns=\"urn:mpeg:dash:schema:mpd:2011\"/>")})
    for (const char* name : {"list.mp4", "list.m3u8", "list.avi"}) {
      WriteAtomically(folder / name, list);
      EXPECT_NE(SentenceOf(folder / name).find("names other files"), std::string::npos)
          << SentenceOf(folder / name);
    }
}

TEST(Footage, KnowsContainersByTheirFirstBytes) {
  using namespace std::string_view_literals;
  for (const auto bytes :
       {"\0\0\0\x20"
        "ftypisom"sv,
        "\x1a\x45\xdf\xa3\x01"sv, "RIFF\x10\0\0\0AVI LIST"sv, "\0\0\x01\xba"sv, "OggS\0"sv})
    EXPECT_TRUE(IsVideoContainer(bytes));
  std::string transport(4 * 188, '\0'), recorder(4 * 192, '\0');
  for (std::size_t i = 0; i < 4; ++i) transport[188 * i] = recorder[192 * i + 4] = 'G';
  EXPECT_TRUE(IsVideoContainer(transport));
  EXPECT_TRUE(IsVideoContainer(recorder));
  for (const auto bytes : {""sv, "G"sv, "RIFF"sv, "RIFF\x10\0\0\0WAVE"sv, "#EXTM3U"sv, "hello"sv})
    EXPECT_FALSE(IsVideoContainer(bytes));
  transport[188] = 'H';
  EXPECT_FALSE(IsVideoContainer(transport));
}

TEST(Footage, DecodersKeepQuiet) {
  const test::TempFolder folder;
  WriteVideo(folder / "clip.avi", 20);
  const std::string bytes = ReadWholeFile(folder / "clip.avi");
  WriteAtomically(folder / "half.avi", bytes.substr(0, bytes.size() / 2));
  WriteAtomically(folder / "notes.mp4", "hello");
  ::testing::internal::CaptureStderr();
  Footage footage = Footage::Open(folder / "half.avi");
  LevelsOf(footage);
  SentenceOf(folder / "notes.mp4");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Footage, SeveralClipsAreReadAsOneAndNameTheirFrames) {
  const test::TempFolder folder;
  fs::create_directory(folder / "b");
  WriteVideo(folder / "a.avi", 3);
  for (int i = 0; i < 2; ++i)
    WritePicture(folder / "b" / fmt::format("{}.png", i), 60 + i, CV_8UC3, {64, 48});
  Footage footage = Footage::Open(Clips{folder / "a.avi", folder / "b"});
  EXPECT_EQ(footage.info().frames, 5);
  EXPECT_EQ(footage.info().name, "a.avi + b");
  for (int pass = 0; pass < 2; ++pass) {
    cv::Mat rgb;
    for (int i = 0; i < 5; ++i) {
      ASSERT_TRUE(i == 1 ? footage.Skip() : footage.Next(rgb));
      EXPECT_EQ(footage.index(), i);
      EXPECT_EQ(footage.clip(), i < 3 ? 0 : 1);
    }
    EXPECT_EQ(rgb.at<cv::Vec3b>(1, 1)[1], 61);
    EXPECT_EQ(footage.NameOf(2), "a.avi:2");
    EXPECT_EQ(footage.NameOf(3), "b:0");
    EXPECT_FALSE(footage.Next(rgb));
    EXPECT_EQ(footage.CutShort(), "");
    footage.Rewind();
  }
  EXPECT_THROW(Footage::Open(Clips{folder / "a.avi", folder / "gone.avi"}), Error);
}

TEST(Footage, RealClipHasAllItsFrames) {
  ARTHRO_REQUIRE_SHARED(clip, "data/laparoscopy_rvim/endo.mp4");
  Footage footage = Footage::Open(clip);
  EXPECT_EQ(footage.info().width, 1280);
  EXPECT_EQ(footage.info().height, 720);
  EXPECT_NEAR(footage.info().frames_per_second, 25.0, 0.01);
  int frames = 0;
  while (footage.Skip()) ++frames;
  EXPECT_EQ(frames, 250);
  EXPECT_EQ(footage.CutShort(), "");
}

}  // namespace
}  // namespace arthro::authoring
