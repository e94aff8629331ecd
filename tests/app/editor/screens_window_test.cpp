// Pictures of a practice beside its window: films, the trainee's screen, and the view from outside.
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/scene/image_io.h"
#include "tests/support/film_frames.h"
#include "tests/support/run_window.h"
#include "tests/support/small_scene.h"

namespace arthro {
namespace {

using test::RunWindow;

class ScreensWindow : public testing::Test {
 protected:
  void SetUp() override {
    ARTHRO_REQUIRE_XVFB();
    scene = test::WriteSmallScene(temp / "knee");
  }
  test::ProgramResult Practise(const std::string& flags, const std::string& script) {
    return RunWindow("practise " + scene.string() + " " + flags, script);
  }
  test::TempFolder temp;
  std::filesystem::path scene;
};

// 90 frames of 1/60 s are 1.5 s of the session; before them the tissue is made ready.
TEST_F(ScreensWindow, APracticeIsRecordedFromItsBeginningAtTrueSpeed) {
  const auto film = temp / "film.mp4";
  const auto result = Practise("--record " + film.string() + " --layout 4:3", R"(
wait job
wait frames 5
expect "Recording 00:00"
hold left 90
expect "Recording 00:01"
expect not "left out"
)");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto [info, frames] = test::ReadFilm(film);
  EXPECT_EQ(info.width, 960);
  EXPECT_EQ(info.height, 720);
  EXPECT_NEAR(info.frames_per_second, 30.0, 1e-9);
  ASSERT_GE(frames.size(), 45u);
  // A second more for the start: at half the speed there would be 90 and more.
  EXPECT_LE(frames.size(), 75u);
  const cv::Mat &first = frames.front(), &last = frames.back();
  ASSERT_FALSE(last.empty());
  EXPECT_LT(cv::mean(last(cv::Rect(0, 0, 110, 720)))[0], 3.0) << "black beside the picture";
  EXPECT_GT(cv::norm(first, last, cv::NORM_L1) / (960.0 * 720 * 3), 3.0) << "the scope swung";
}

TEST_F(ScreensWindow, TheCommandAsksWhereAndEndsTheFilmThePracticeGoesOn) {
  const auto result = Practise("", R"(
wait job
expect not "Recording"
key f2
expect "Record a film"
set "File name" ")" + (temp / "mine.avi").string() +
                                       R"("
wait frames 20
expect "Recording 00:00"
key f2
wait job
expect not "Recording"
expect "The film is in"
expect "Force on the tissue"
)");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GE(authoring::Footage::Open(temp / "mine.avi").info().frames, 5);
}

// Pictures instead of a film. Their contents are tested in tests/app/recording.
TEST_F(ScreensWindow, APracticeIsRecordedAsPicturesByTheFlagAndByTheCommand) {
  const auto by_flag = temp / "flag", by_command = temp / "command";
  std::filesystem::create_directory(by_command);
  const auto result = Practise("--record " + by_flag.string() + "/ --layout 16:9", R"(
wait job
hold left 60
key f2
wait job
expect "The pictures are in"
key f2
expect "numbered pictures"
set "File name" ")" + (by_command / "frame.png").string() +
                                                                                       R"("
wait frames 20
key f2
wait job
expect "The pictures are in"
key f2
set "File name" ")" + (by_command / "frame-%04d.png").string() +
                                                                                       R"("
expect "this folder is not empty"
)");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto count = [](const std::filesystem::path& folder) {
    return std::distance(std::filesystem::directory_iterator(folder),
                         std::filesystem::directory_iterator());
  };
  EXPECT_GE(count(by_flag), 30) << "a second at least";
  EXPECT_GE(count(by_command), 10);
  const ColourImage first = ReadColourImage(by_flag / "frame_00000.png"),
                    last = ReadColourImage(by_flag / "frame_00029.png");
  EXPECT_EQ(first.width, 1280);
  EXPECT_EQ(first.height, 720);
  EXPECT_NE(first.rgb, last.rgb) << "the scope swung";
  EXPECT_EQ(last.at(100, 360)[0], 0) << "black beside the picture";
  EXPECT_TRUE(std::filesystem::exists(by_command / "frame-0000.png"));
}

// Mean brightness of the pixels of `area`; 0 is black.
double MeanOf(const ColourImage& picture, const cv::Rect& area) {
  double sum = 0;
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x)
      for (int c = 0; c < 3; ++c) sum += picture.at(x, y)[c];
  return sum / (3.0 * area.width * area.height);
}

// Each disturbance alone and some at once, while a film is recorded, the window is resized, the
// view from outside and the trainee's screen come and go. The scene's own mean is 60 and more in
// the middle of the picture; a strong disturbance leaves a third of it.
TEST_F(ScreensWindow, ARecordedPracticeNeverShowsABlackPicture) {
  const std::vector<std::string> switches = {"Bleeding",  "Bubbles",  "Debris",     "Fogged lens",
                                             "Near blur", "Far blur", "Overexposed"};
  std::string script = "wait job\nkey f2\nset \"File name\" \"" + (temp / "film.avi").string() +
                       "\"\nwait frames 3\nexpect \"Recording 00:00\"\nkey f3\n";
  struct Shot {
    std::filesystem::path file;
    cv::Rect picture;
  };
  std::vector<Shot> shots;
  const auto shoot = [&](const std::string& name) {
    for (const auto& [width, height] : {std::pair(900, 600), std::pair(760, 700)}) {
      const auto file = temp / (std::to_string(shots.size()) + ".png");
      // The controls take 0.4 of the width on the right.
      const int middle = width * 3 / 10;
      shots.push_back({file, cv::Rect(middle - 60, height / 2 - 60, 120, 120)});
      script += "resize " + std::to_string(width) + " " + std::to_string(height) +
                "\nwait frames 4\nshot " + file.string() + "\n";
      const auto trainee = temp / (std::to_string(shots.size()) + ".png");
      if (name == "Fogged lens") {
        script += "shot-trainee " + trainee.string() + "\n";
        shots.push_back({trainee, cv::Rect(380, 260, 200, 200)});
      }
    }
  };
  for (const std::string& name : switches) {
    script += "click \"" + name + "\"\nexpect value \"" + name + "\" on\n";
    if (name == "Fogged lens") script += "key f12\nkey o\nwait frames 4\n";
    shoot(name);
    script += "click \"" + name + "\"\n";
    if (name == "Fogged lens") script += "key f12\nkey o\n";
  }
  script += "click Bleeding\nclick Bubbles\nclick Debris\nclick \"Near blur\"\n";
  shoot("all");
  script += "click \"Clear view\"\n";
  shoot("clear");
  script += "key f2\nwait job\nclick \"Hide disturbances\"\nexpect \"The film is in\"\n";
  const auto result = RunWindow("practise --layout 4:3 " + scene.string(), script, "1600x1200x24");
  ASSERT_EQ(result.exit_code, 0) << result.err;

  double darkest_shot = 255, darkest_frame = 255;
  for (const Shot& shot : shots) {
    const double mean = MeanOf(ReadColourImage(shot.file), shot.picture);
    EXPECT_GT(mean, 15.0) << shot.file.filename();
    darkest_shot = std::min(darkest_shot, mean);
  }
  const test::Film film = test::ReadFilm(temp / "film.avi");
  EXPECT_GE(film.frames.size(), 20u);
  for (std::size_t i = 0; i < film.frames.size(); ++i) {
    const cv::Scalar mean = cv::mean(film.frames[i](cv::Rect(380, 260, 200, 200)));
    const double grey = (mean[0] + mean[1] + mean[2]) / 3;
    EXPECT_GT(grey, 15.0) << "frame " << i;
    darkest_frame = std::min(darkest_frame, grey);
  }
  std::printf("%zu pictures, the darkest of mean %.1f; %zu frames, the darkest of mean %.1f\n",
              shots.size(), darkest_shot, film.frames.size(), darkest_frame);
}

TEST_F(ScreensWindow, AFilmThatCannotBeIsRefusedBeforeThereIsAWindow) {
  // The scene's own folder is not empty.
  for (const char* file : {"film.gif", "no/film.mp4", "knee", "knee/frame-%03d.png", "a.png"}) {
    const auto result = test::RunProgram(
        "practise " + scene.string() + " --record " + (temp / file).string(), "DISPLAY=");
    EXPECT_EQ(result.exit_code, 1) << file;
    EXPECT_EQ(result.err.find("display"), std::string::npos) << result.err;
  }
  const auto result = test::RunProgram("practise " + scene.string() + " --layout 5:4", "DISPLAY=");
  EXPECT_NE(result.err.find("square, 4:3 or 16:9"), std::string::npos) << result.err;
}

TEST_F(ScreensWindow, TheViewFromOutsideStandsInACornerUntilItIsTakenAway) {
  const auto without = temp / "without.png", with = temp / "with.png", again = temp / "again.png";
  const auto result =
      Practise("", "wait job\nwait frames 10\nshot " + without.string() +
                       "\nclick \"From outside\"\nexpect Overview\nhover \"Full screen\"\n"
                       "wait frames 10\nshot " +
                       with.string() + "\nkey o\nexpect not Overview\nwait frames 10\nshot " +
                       again.string() + "\n");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const ColourImage a = ReadColourImage(without), b = ReadColourImage(with),
                    c = ReadColourImage(again);
  // The picture's area is 910 px wide, the corner 272x204 of it.
  long inside = 0, outside = 0, left = 0;
  for (int y = 0; y < 800; ++y)
    for (int x = 0; x < 910; ++x) {
      const bool is_corner = x < 290 && y > 580;
      const bool differs = std::abs(a.at(x, y)[0] - b.at(x, y)[0]) > 8;
      (is_corner ? inside : outside) += differs;
      left += std::abs(a.at(x, y)[0] - c.at(x, y)[0]) > 8;
    }
  EXPECT_GT(inside, 20000);
  EXPECT_EQ(outside, 0) << "the hands stand still";
  EXPECT_EQ(left, 0);
}

// Angle of the mark of the round picture in a window of 1280x800, in degrees clockwise from the
// top. The mark is black and reaches 0.925 of the radius.
double MarkAngle(const ColourImage& window) {
  const double centre_x = 455, centre_y = 400, radius = 392;
  double darkest = 1e9, found = 0;
  for (double degrees = -180; degrees < 180; degrees += 0.5) {
    const double a = degrees * std::numbers::pi / 180;
    double sum = 0;
    for (double r = 0.94; r < 0.975; r += 0.005)
      sum += window.at(static_cast<int>(centre_x + r * radius * std::sin(a)),
                       static_cast<int>(centre_y - r * radius * std::cos(a)))[0];
    if (sum < darkest) darkest = sum, found = degrees;
  }
  return found;
}

// Pixels of the picture's area that differ.
long Differing(const ColourImage& a, const ColourImage& b) {
  long count = 0;
  for (int y = 0; y < 800; ++y)
    for (int x = 0; x < 910; ++x) count += !std::equal(a.at(x, y), a.at(x, y) + 3, b.at(x, y));
  return count;
}

// Held for 40 frames of 1/60 s, E rolls the scope by 46 degrees, and H turns the head by 27; a key
// is down for a frame or two more.
TEST_F(ScreensWindow, TheCameraHeadTurnsWithTheScopeOrIsHeldAndTheRimsMarkFollows) {
  std::string script = "wait job\nwait frames 5\nexpect value \"With scope\" on\n";
  const auto shoot = [&](const std::string& name) {
    script += "hover \"Full screen\"\nwait frames 10\nshot " + (temp / name).string() + "\n";
  };
  script += "hold e 40\n";
  shoot("with.png");
  script += "click Upright\nexpect value Upright on\nexpect value \"With scope\" off\n";
  shoot("upright.png");
  script += "hold h 40\nexpect \"to the right\"\n";
  shoot("turned.png");
  script +=
      "key u\nexpect not \"to the right\"\nclick \"Turn right\"\n"
      "expect \"turned 2° to the right\"\nclick \"Turn left\"\n"
      "click \"Turn left\"\nexpect \"turned 2° to the left\"\nclick \"Turn right\"\n";
  shoot("again.png");
  script += "key t\nexpect value \"With scope\" on\n";
  shoot("back.png");
  const auto result = Practise("", script);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto read = [&](const char* name) { return ReadColourImage(temp / name); };
  const ColourImage with = read("with.png"), upright = read("upright.png");
  const double roll = MarkAngle(upright), turned = MarkAngle(read("turned.png"));
  std::printf("mark at %.1f with the scope, %.1f upright, %.1f turned\n", MarkAngle(with), roll,
              turned);
  EXPECT_NEAR(MarkAngle(with), 0.0, 1.5);
  EXPECT_NEAR(roll, 47.5, 3.0);
  EXPECT_NEAR(roll - turned, 27.5, 2.5);
  // Only the flecks of the fluid drifted on meanwhile.
  EXPECT_LT(Differing(read("again.png"), upright), 4000);
  EXPECT_LT(Differing(read("back.png"), with), 4000);
  EXPECT_GT(Differing(upright, with), 100000);
}

TEST_F(ScreensWindow, APracticeCanBeginWithTheHeadUprightAndNoOtherWordIsTaken) {
  EXPECT_EQ(Practise("--head upright", "wait job\nexpect value Upright on\n").exit_code, 0);
  const auto result = test::RunProgram("practise " + scene.string() + " --head up", "DISPLAY=");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("give one of the two"), std::string::npos) << result.err;
}

// The picture's pixels in both windows: 600x600 in the first, which its size of 986x616 leaves it,
// scaled to the second one's 720. Linear scaling of smooth pictures keeps each
// within a few levels; only the rim's step of black to bright is wider in one than in the other.
TEST_F(ScreensWindow, TheTraineesScreenShowsThePictureAndNothingElse) {
  const auto shot = temp / "window.png", trainee = temp / "trainee.png";
  const auto result =
      Practise("--size 986x616 --trainee-screen --layout 4:3",
               "wait job\nwait frames 5\nexpect \"There is one monitor\"\nhold left 20\n"
               "wait frames 5\nshot " +
                   shot.string() + "\nshot-trainee " + trainee.string() +
                   "\nkey f12\nwait frames 3\nexpect not \"one monitor\"\n"
                   "key f12\nwait frames 3\nexpect \"There is one monitor\"\n");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const ColourImage window = ReadColourImage(shot), screen = ReadColourImage(trainee);
  ASSERT_EQ(screen.width, 960);
  ASSERT_EQ(screen.height, 720);
  for (int y = 0; y < 720; ++y)
    for (const int x : {0, 60, 119, 840, 959}) EXPECT_EQ(screen.at(x, y)[0], 0) << x << " " << y;
  const int left = 8, top = 8;  // px, corner of the picture in the first window
  long off = 0, all = 0;
  for (int y = 90; y < 630; ++y)
    for (int x = 210; x < 750; ++x) {
      const double across = x - 120 + 0.5 - 360, down = y + 0.5 - 360;
      if (across * across + down * down > 330.0 * 330.0) continue;
      const int u = left + static_cast<int>((x - 120 + 0.5) / 1.2),
                v = top + static_cast<int>((y + 0.5) / 1.2);
      ++all;
      off += std::abs(screen.at(x, y)[0] - window.at(u, v)[0]) > 24;
    }
  EXPECT_LT(static_cast<double>(off) / static_cast<double>(all), 0.02);
  std::printf("%.2f %% of the pixels differ by more than 24\n",
              100.0 * static_cast<double>(off) / static_cast<double>(all));
}

}  // namespace
}  // namespace arthro
