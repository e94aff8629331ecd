// Log of an attempt: what is written comes back bit by bit, and a recording that is cut short keeps
// what it has.
#include "simulation/training/attempt_log.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/byte_stream.h"
#include "simulation/core/error.h"
#include "simulation/training/assessment.h"
#include "tests/support/temp_folder.h"

namespace arthro::simulation {
namespace {

const std::vector<LogSource> kHands{{"", "", "1", {DeviceRole::kScope, DeviceRole::kInstrument}}};

// Hands that never rest, which look at `targets` targets.
class MovingHands {
 public:
  explicit MovingHands(int targets) : targets_(targets) {}
  AttemptFrame Next() {
    AttemptFrame frame;
    // One frame in three is in contact; else the drawn tip is the tip, and there is no force.
    const bool touches = random_() % 3 == 0;
    for (ToolFrame& tool : frame.tool) {
      tool.tip = tool.drawn_tip = Vector();
      tool.axis = Vector();
      tool.roll = Number();
      tool.depth = Number();
      tool.is_valid = random_() % 50 != 0;
      if (!touches) continue;
      tool.drawn_tip = Vector();
      tool.mean_force = Number();
      tool.peak_force = Number();
      tool.contact_share = Number();
      tool.contact = static_cast<int>(random_() % 3);
    }
    frame.lens = random_() % 10 == 0 ? Vector() : frame.tool[0].drawn_tip;
    frame.head_roll = frame.tool[0].roll;
    frame.opening = random_() % 10 == 0 ? Number() : 1.0F;
    frame.view_angle = 0.5236F;
    frame.incision_spacing = 0.03F;
    frame.instrument = ToolKind::kShaver;
    frame.is_paused = random_() % 100 == 0;
    frame.sight.targets = targets_;
    frame.sight.is_tip_visible = random_() % 2 == 0;
    for (int i = 0; i < targets_; ++i) {
      PointSight& sight = frame.sight.target[static_cast<std::size_t>(i)];
      sight.place = glm::vec3(0.001F * static_cast<float>(i));
      sight.centre = random_() % 4 == 0 ? std::numeric_limits<float>::infinity() : Number();
      sight.distance = Number();
      sight.incidence = Number();
      sight.is_clear = random_() % 2 == 0;
    }
    return frame;
  }

 private:
  float Number() { return std::uniform_real_distribution(-1.0F, 1.0F)(random_); }
  glm::vec3 Vector() { return {Number(), Number(), Number()}; }
  std::mt19937 random_{5};
  int targets_;
};

class AttemptLogs : public testing::Test {
 protected:
  std::vector<AttemptFrame> Record(int frames, int targets) {
    AttemptLog log(file, kHands, R"({"exercise": "probe-five"})");
    MovingHands hands(targets);
    std::vector<AttemptFrame> written;
    for (int i = 0; i < frames; ++i) {
      log.Add(written.emplace_back(hands.Next()));
      if (i == 10) log.Add(event);
    }
    log.Close();
    return written;
  }
  test::TempFolder folder;
  const std::filesystem::path file = folder / "a.attempt";
  const AttemptEvent event{0.11, EventKind::kProbed, "s1", "edge", 1.25, "a note"};
};

TEST_F(AttemptLogs, FramesAndEventsComeBackBitByBit) {
  const auto written = Record(1234, 5);
  const RecordedAttempt attempt = ReadAttempt(file);
  EXPECT_EQ(attempt.frames, written);
  EXPECT_EQ(attempt.events, std::vector{event});
  EXPECT_EQ(attempt.head, R"({"exercise": "probe-five"})");
  EXPECT_EQ(attempt.hands, kHands);
  EXPECT_EQ(attempt.torn, "");
}

TEST_F(AttemptLogs, LogThatIsCutShortLosesItsLastQuarterOfASecondAtMost) {
  const auto written = Record(1000, 5);
  const std::string bytes = ReadWholeFile(file);
  std::mt19937 random(9);
  std::size_t most = 0;
  for (int i = 0; i < 60; ++i) {
    const std::size_t size = 2000 + random() % (bytes.size() - 2000);
    const RecordedAttempt attempt = AttemptOf(ParseDeviceLog(bytes.substr(0, size)));
    ASSERT_LE(attempt.frames.size(), written.size());
    EXPECT_TRUE(std::equal(attempt.frames.begin(), attempt.frames.end(), written.begin()));
    EXPECT_NE(attempt.torn, "");
    // Frames whose bytes were in the file before the cut.
    const double there = static_cast<double>(size) / static_cast<double>(bytes.size()) * 1000;
    most = std::max(most, static_cast<std::size_t>(
                              std::max(0.0, there - static_cast<double>(attempt.frames.size()))));
  }
  EXPECT_LE(most, 27U) << "25 frames of a block, and two for the head of the file";
}

TEST_F(AttemptLogs, TenMinutesStayBelowTwentyMegabytes) {
  const auto written = Record(60000, kMostTargets);
  const auto size = std::filesystem::file_size(file);
  EXPECT_LE(size, 20'000'000U) << static_cast<double>(size) / 60000 << " bytes per frame";
  const auto begin = std::chrono::steady_clock::now();
  const RecordedAttempt attempt = ReadAttempt(file);
  const Assessment assessment = AssessFrames(attempt.frames, Scene());
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_EQ(attempt.frames.size(), written.size());
  EXPECT_NEAR(assessment.duration, 600, 1e-9);
  fmt::print("ten minutes: {:.1f} MB, read and measured in {:.2f} s\n",
             1e-6 * static_cast<double>(size), seconds);
  // The goal is one second on a quiet machine.
  EXPECT_LT(seconds, 20);
}

// Hands that swing once a second: from frame to frame their distance from a straight line is some
// (2 pi / 100)² of the swing, which of 24 bits leaves 16, and so three bytes. The mask is left out.
TEST(FrameCode, SmoothHandsTakeThreeBytesForAWordAndNoMask) {
  FrameEncoder encoder;
  FrameDecoder decoder;
  std::string bytes;
  constexpr std::size_t kMoving = 2 * 8;  // words
  std::size_t sum = 0;
  for (int i = 0; i < 900; ++i) {
    const double t = kFrameTime * i, swing = std::sin(2 * std::numbers::pi * t);
    AttemptFrame frame;
    for (ToolFrame& tool : frame.tool) {
      tool.tip = {0.01 * swing, 0.012 * std::cos(5 * t), 0.03 + 0.002 * swing};
      tool.drawn_tip = tool.tip;
      tool.axis = {0.3 * swing, 0.4 * std::cos(5 * t), 0.9};
      tool.roll = static_cast<float>(0.2 * std::cos(3 * t));
      tool.depth = static_cast<float>(0.03 + 0.002 * swing);
    }
    encoder.Encode(frame, bytes);
    AttemptFrame again;
    ASSERT_TRUE(decoder.Decode(bytes, again));
    ASSERT_EQ(again, frame);
    if (i == 0) continue;  // it is whole
    sum += bytes.size();
  }
  std::printf("%.1f bytes per frame, with whole words and mask %zu\n",
              static_cast<double>(sum) / 899, 1 + sizeof(FrameMask) + kMoving * sizeof(float));
  EXPECT_LT(sum, 899 * (1 + 3 * kMoving) + 899 * kMoving / 4)
      << "one word in four may need a fourth";
}

// Frames of the first logs: a first byte of at most 3, a mask, whole words.
TEST(FrameCode, FramesOfTheFirstLogsAreRead) {
  FrameDecoder decoder;
  const auto frame_of = [&](std::uint8_t head, float tip_x) {
    std::string bytes;
    FrameMask mask{};
    mask[0] = 1;
    PutBytes(bytes, head);
    PutBytes(bytes, mask);
    PutBytes(bytes, tip_x);
    AttemptFrame frame;
    EXPECT_TRUE(decoder.Decode(bytes, frame));
    return frame;
  };
  for (const float tip_x : {0.25F, 0.5F, -3.0F}) {
    const AttemptFrame frame = frame_of(tip_x == 0.25F ? 1 : 0, tip_x);
    EXPECT_EQ(frame.tool[0].tip, glm::vec3(tip_x, 0, 0));
    EXPECT_EQ(frame.tool[0].drawn_tip, frame.tool[0].tip) << "kept as its difference";
    EXPECT_EQ(frame.lens, frame.tool[0].tip);
    EXPECT_EQ(frame.tool[1].tip, glm::vec3(0));
  }
}

// Frames that end early or late, and flags of a later program.
TEST(FrameCode, DamagedFramesAreRefused) {
  FrameEncoder encoder;
  FrameDecoder before;
  std::string bytes;
  AttemptFrame frame;
  for (int i = 0; i < 4; ++i) {
    frame.tool[0].tip.x = 0.01F * static_cast<float>(i);
    encoder.Encode(frame, bytes);
    if (i == 3) break;
    AttemptFrame again;
    ASSERT_TRUE(before.Decode(bytes, again));
  }
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    FrameDecoder decoder = before;
    EXPECT_FALSE(decoder.Decode(std::string_view(bytes).substr(0, size), frame)) << size;
  }
  EXPECT_FALSE(FrameDecoder().Decode(bytes + "x", frame));
  EXPECT_FALSE(FrameDecoder().Decode("\x10", frame));
}

TEST_F(AttemptLogs, FullDiskIsToldAtTheEnd) {
  AttemptLog log(file, kHands, "");
  MovingHands hands(1);
  log.Add(hands.Next());
  log.Close();
  EXPECT_THROW(AttemptLog(file, kHands, ""), Error) << "a log is not overwritten";
  EXPECT_THROW(AttemptLog("/dev/full", kHands, ""), Error);
}

TEST_F(AttemptLogs, LogOfHandsIsNoAttempt) {
  const std::string bytes = LogHead(kHands) + LogEnd(0);
  EXPECT_FALSE(IsAttempt(ParseDeviceLog(bytes)));
  EXPECT_THROW(AttemptOf(ParseDeviceLog(bytes)), Error);
}

// An attempt with frames and three pieces of tissue.
std::string WithTissue(const std::filesystem::path& file, std::vector<AttemptFrame>& frames) {
  AttemptLog log(file, kHands, "{}");
  MovingHands hands(2);
  for (int i = 1; i <= 300; ++i) {
    log.Add(frames.emplace_back(hands.Next()));
    if (i % 100 == 0)
      log.Add(TrackPiece{0.01 * i, std::string(100'000, static_cast<char>('a' + i / 100))});
  }
  log.Close();
  return ReadWholeFile(file);
}

TEST_F(AttemptLogs, PiecesOfTissueComeBackAndAreNotAmongTheFrames) {
  std::vector<AttemptFrame> frames;
  WithTissue(file, frames);
  const RecordedAttempt attempt = ReadAttempt(file);
  EXPECT_EQ(attempt.frames, frames);
  ASSERT_EQ(attempt.track.size(), 3U);
  EXPECT_NEAR(attempt.track[1].t, 2, 1e-9);
  EXPECT_EQ(attempt.track[1].bytes, std::string(100'000, 'c')) << "larger than a record may be";
  EXPECT_EQ(attempt.track_fault, "");
  EXPECT_EQ(attempt.torn, "");
}

TEST_F(AttemptLogs, DamagedPieceOfTissueIsToldAndTheAttemptOpens) {
  std::vector<AttemptFrame> frames;
  std::string bytes = WithTissue(file, frames);
  bytes[bytes.find("cccccc") + 500] = 'x';
  const RecordedAttempt attempt = AttemptOf(ParseDeviceLog(bytes));
  EXPECT_EQ(attempt.frames, frames);
  EXPECT_EQ(attempt.track.size(), 2U);
  EXPECT_NE(attempt.track_fault.find("1 of 3 records of the tissue are damaged"), std::string::npos)
      << attempt.track_fault;
  EXPECT_EQ(attempt.torn, "");
}

TEST_F(AttemptLogs, LogThatEndsInAPieceOfTissueKeepsTheFramesBefore) {
  std::vector<AttemptFrame> frames;
  const std::string bytes = WithTissue(file, frames);
  const RecordedAttempt attempt =
      AttemptOf(ParseDeviceLog(bytes.substr(0, bytes.find("cccccc") + 500)));
  EXPECT_EQ(attempt.track.size(), 1U);
  EXPECT_GE(attempt.frames.size(), 173U);
  EXPECT_NE(attempt.torn, "");
}

TEST_F(AttemptLogs, DamagedFrameIsRefused) {
  std::string payload;
  AppendBody(LogKind::kAttempt, 0, 0, "", payload);
  AppendBody(LogKind::kFrame, 10'000'000, 1, "no frame", payload);
  const std::string bytes = LogHead(kHands) + LogBlock(payload, 2) + LogEnd(2);
  EXPECT_THROW(AttemptOf(ParseDeviceLog(bytes)), Error);
  for (const char* body : {"", "\xff", "an event that is none"}) {
    payload.clear();
    AppendBody(LogKind::kAttempt, 0, 0, "", payload);
    AppendBody(LogKind::kEvent, 10'000'000, 1, body, payload);
    const std::string event_bytes = LogHead(kHands) + LogBlock(payload, 2) + LogEnd(2);
    EXPECT_THROW(AttemptOf(ParseDeviceLog(event_bytes)), Error) << body;
  }
}

}  // namespace
}  // namespace arthro::simulation
