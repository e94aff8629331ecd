// A session again from what its devices said.
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/device/log/log_format.h"
#include "simulation/device/log/log_replay.h"
#include "simulation/scene/image_io.h"
#include "simulation/scope/rod_pose.h"
#include "tests/support/build_paths.h"
#include "tests/support/film_frames.h"
#include "tests/support/run_program.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

using namespace simulation;

TEST(ReplayJob, ADeviceLogGivesTheForcesOfItsTraceEachTime) {
  TempFolder folder;
  const std::string demo = std::string(ARTHRO_SOURCE_DIR) + "/resources/demo";
  // The instrument of the demo's own trace as a device would have said it, from some time on.
  const auto demo_trace = ReadTrace(demo + "/trace.csv");
  const LogSource source{"", "", "1", {DeviceRole::kInstrument, {}}};
  std::string payload;
  LogRecord record;
  std::uint32_t count = 0;
  for (const TraceRow& row : demo_trace) {
    if (row.device != DeviceRole::kInstrument || row.sample.t > demo_trace[0].sample.t + 3)
      continue;
    record.t_ns = static_cast<std::int64_t>(1e9 * (row.sample.t + 1000));
    record.number = count++;
    record.sample = row.sample;
    record.sample.t += 1000;
    Append(record, payload);
  }
  ASSERT_GT(count, 50u);
  const std::string log = LogHead({&source, 1}) + LogBlock(payload, count);
  WriteAtomically(folder / "session.bin", log + LogEnd(count));
  WriteTrace(folder / "trace.csv", RecordingOf(ParseDeviceLog(log)).rows);
  const auto forces = [&](const std::string& input, const std::string& output) {
    const ProgramResult run = RunProgram("replay " + demo + " " + (folder / input).string() +
                                         " -o " + (folder / output).string());
    EXPECT_EQ(run.exit_code, 0) << run.err;
    if (input == "torn.bin") {
      EXPECT_NE(run.err.find("was cut short"), std::string::npos) << run.err;
    }
    return ReadWholeFile(folder / output);
  };
  const std::string expected = forces("trace.csv", "a.csv");
  EXPECT_GT(expected.size(), 50u * count);
  EXPECT_TRUE(forces("session.bin", "b.csv") == expected);
  EXPECT_TRUE(forces("session.bin", "c.csv") == expected);
  // The machine went off in the middle of the next block.
  WriteAtomically(folder / "torn.bin", log + LogBlock(payload, count).substr(0, 1000));
  EXPECT_TRUE(forces("torn.bin", "d.csv") == expected);
}

// Both hands swing for a second, with a row every 7 ms and a pause of 0.2 s in the middle.
std::filesystem::path WriteSwing(const std::filesystem::path& file) {
  std::vector<TraceRow> trace;
  for (double t = 3.0; t<4.0001; t += t> 3.4 && t < 3.5 ? 0.2 : 0.007)
    for (const DeviceRole device : {DeviceRole::kScope, DeviceRole::kInstrument}) {
      TraceRow& row = trace.emplace_back();
      row.device = device;
      row.sample.t = t;
      row.sample.hip_in_device = {0.01 * std::sin(9 * t), 0.01 * std::cos(7 * t), -0.18};
      row.sample.valid = true;
    }
  trace.push_back(trace.back());
  trace.back().sample.t = 4.0;
  std::erase_if(trace, [](const TraceRow& row) { return row.sample.t > 4.0; });
  WriteTrace(file, trace);
  return file;
}

// 33 dB in luma as in tests/app/recording; pictures a sixth of a second apart differ by more.
TEST(ReplayJob, AFilmLastsAsLongAsTheTraceAndHoldsThePictures) {
  TempFolder folder;
  const auto scene = WriteSmallScene(folder / "knee");
  const auto trace = WriteSwing(folder / "swing.csv");
  const auto play = [&](const std::string& flags) {
    return RunProgram("replay " + scene.string() + " " + trace.string() + " -o " +
                      (folder / "f.csv").string() + " " + flags);
  };
  ASSERT_EQ(play("").exit_code, 0);
  const std::string forces = ReadWholeFile(folder / "f.csv");
  const auto film = folder / "film.mp4";
  const ProgramResult run =
      play("--video " + film.string() + " --video-size 180 --fps 24 --layout 4:3 --pictures " +
           (folder / "frames").string() + " --size 180 --rate 6");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_TRUE(ReadWholeFile(folder / "f.csv") == forces) << "looking changed the forces";

  const auto [info, frames] = ReadFilm(film);
  EXPECT_EQ(info.width, 240);
  EXPECT_EQ(info.height, 180);
  EXPECT_NEAR(info.frames_per_second, 24.0, 1e-9);
  ASSERT_EQ(frames.size(), 24u) << "one second";
  double worst = 1e9;
  for (int i = 0; i < 6; ++i) {
    const ColourImage picture =
        ReadColourImage(folder / "frames" / fmt::format("frame_{:05}.png", i));
    ASSERT_EQ(picture.width, 240);
    const double own = LumaPsnr(frames[static_cast<std::size_t>(4 * i)], picture);
    worst = std::min(worst, own);
    for (std::size_t other = 0; other < frames.size(); other += 4)
      if (other != static_cast<std::size_t>(4 * i)) {
        EXPECT_LT(LumaPsnr(frames[other], picture), own - 3.0) << i << " and " << other;
      }
    for (int x = 0; x < 30; ++x) EXPECT_EQ(picture.at(x, 90)[0], 0) << "black beside it";
  }
  EXPECT_GT(worst, 33.0);
  EXPECT_FALSE(std::filesystem::exists(folder / "frames" / "frame_00006.png"));
  std::printf("worst frame %.1f dB\n", worst);

  const std::string bytes = ReadWholeFile(film);
  ASSERT_EQ(play("--overwrite --video " + film.string() + " --video-size 180 --fps 24 --layout 4:3")
                .exit_code,
            0);
  EXPECT_TRUE(ReadWholeFile(film) == bytes) << "the same trace gave another film";
}

TEST(ReplayJob, DisturbsItsPicturesByTheTimeOfTheTrace) {
  TempFolder folder;
  const auto scene = WriteSmallScene(folder / "knee");
  const auto trace = WriteSwing(folder / "swing.csv");
  const auto play = [&](const std::string& name, const std::string& flags) {
    const ProgramResult run =
        RunProgram("replay " + scene.string() + " " + trace.string() + " -o " +
                   (folder / (name + ".csv")).string() + " --size 96 --rate 3 --pictures " +
                   (folder / name).string() + " " + flags);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return ReadColourImage(folder / name / "frame_00001.png").rgb;
  };
  const auto clear = play("clear", ""), hazy = play("hazy", "--disturb haze=0.7,bubbles=0.5");
  EXPECT_NE(hazy, clear);
  EXPECT_EQ(play("again", "--disturb haze=0.7,bubbles=0.5 --disturb-seed 0"), hazy);
  EXPECT_NE(play("bare", "--no-flecks"), clear);
  EXPECT_NE(play("other", "--disturb haze=0.7,bubbles=0.5 --disturb-seed 4"), hazy);
  EXPECT_EQ(ReadWholeFile(folder / "hazy.csv"), ReadWholeFile(folder / "clear.csv"))
      << "disturbances changed the forces";
  const ProgramResult wrong =
      RunProgram("replay " + scene.string() + " " + trace.string() + " -o " +
                 (folder / "w.csv").string() + " --disturb hase=1");
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_NE(wrong.err.find("hase"), std::string::npos) << wrong.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "w.csv"));
}

// A scope at a view angle of 30 degrees that is rolled by a quarter turn: upright, its picture is
// the one that turns with it, a quarter turn to the right, but for the lamp, which stands above the
// lens.
TEST(ReplayJob, PicturesHoldTheCameraHeadUprightOrTurnItWithTheScope) {
  TempFolder folder;
  const auto scene = WriteSmallScene(folder / "knee");
  std::vector<TraceRow> trace(2);
  trace[1].sample.t = 0.01;
  for (TraceRow& row : trace) {
    const RodPose pose{0.1, 0.2, 0.5 * std::numbers::pi, 0.012};
    row.device = DeviceRole::kScope;
    row.sample.hip_in_device = HipFromRodPose(pose, {});
    row.sample.handle_in_device = HandleFromRodPose(pose, {});
    row.sample.valid = true;
  }
  WriteTrace(folder / "rolled.csv", trace);
  const auto seen = [&](const std::string& name, const std::string& flags) {
    const ProgramResult run =
        RunProgram("replay " + scene.string() + " " + (folder / "rolled.csv").string() + " -o " +
                   (folder / "f.csv").string() + " --pictures " + (folder / name).string() +
                   " --size 200 " + flags);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const ColourImage picture = ReadColourImage(folder / name / "frame_00000.png");
    return cv::Mat(picture.height, picture.width, CV_8UC3,
                   const_cast<std::uint8_t*>(picture.rgb.data()))
        .clone();
  };
  const cv::Mat usual = seen("a", ""), upright = seen("b", "--head upright"),
                with = seen("c", "--head scope");
  const auto off = [&](const cv::Mat& a, const cv::Mat& b) {
    return cv::norm(a, b, cv::NORM_L1) / (3.0 * 200 * 200);
  };
  cv::Mat turned;
  cv::rotate(with, turned, cv::ROTATE_90_CLOCKWISE);
  std::printf("off by %.2f of 255, %.2f where it is not turned\n", off(turned, upright),
              off(with, upright));
  EXPECT_EQ(off(usual, upright), 0.0);
  EXPECT_LT(off(turned, upright), 2.0);
  EXPECT_GT(off(with, upright), 10.0);
  EXPECT_EQ(RunProgram("replay " + scene.string() + " " + (folder / "rolled.csv").string() +
                       " -o " + (folder / "g.csv").string() + " --head left")
                .exit_code,
            1);
  EXPECT_FALSE(std::filesystem::exists(folder / "g.csv"));
}

TEST(ReplayJob, AFilmThatCannotBeIsRefusedBeforeAnythingIsPlayed) {
  TempFolder folder;
  const auto scene = WriteSmallScene(folder / "knee");
  const auto trace = WriteSwing(folder / "swing.csv");
  const auto refusal = [&](const std::string& flags, int code = 1) {
    const ProgramResult run = RunProgram("replay " + scene.string() + " " + trace.string() +
                                         " -o " + (folder / "f.csv").string() + " " + flags);
    EXPECT_EQ(run.exit_code, code) << flags;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "f.csv")) << flags;
    return run.err;
  };
  const std::string film = "--video " + (folder / "film").string();
  EXPECT_NE(refusal(film + ".gif").find(".mp4, .mkv or .avi"), std::string::npos);
  EXPECT_NE(refusal("--video " + (folder / "no" / "film.mp4").string()).find("does not exist"),
            std::string::npos);
  EXPECT_NE(refusal(film + ".mp4 --video-size 181").find("even"), std::string::npos);
  // Outside a flag's range is wrong use.
  EXPECT_NE(refusal(film + ".mp4 --video-size 0", 2).find("from 16 to 4096 px"), std::string::npos);
  EXPECT_NE(refusal(film + ".mp4 --fps 0", 2).find("from 1 to 240 per second"), std::string::npos);
  EXPECT_NE(refusal(film + ".mp4 --layout 5:4").find("square, 4:3 or 16:9"), std::string::npos);
  EXPECT_NE(refusal("--video " + trace.string()).find("would overwrite it"), std::string::npos);
}

}  // namespace
}  // namespace arthro::test
