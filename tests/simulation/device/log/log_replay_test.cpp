// Replay of the log of a live device.
#include "simulation/device/log/log_replay.h"

#include <random>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/device/log/logged_device.h"
#include "tests/simulation/device/live/arm_bench.h"

namespace arthro::simulation {
namespace {

using test::Bytes;
using test::WaitUntil;

const std::string kPath = "/dev/fake0";

// A WoodenHaptics that is homed, moved, sends an invalid report, is unplugged and comes back;
// logged in `file`.
void Record(const std::filesystem::path& file) {
  test::ArmBench bench;
  bench.usb.Plug(test::WoodenArm(L"A", kPath));
  test::Board board(bench.usb, kPath);
  DeviceLogOptions log_options;
  log_options.write_every = 1e-3;  // many blocks
  DeviceLog log(file,
                {{"wooden_haptics", "woodenhaptics_2015", "A", {DeviceRole::kInstrument, {}}}},
                log_options);
  LoggedReports reports(log, 0);
  LiveOptions options;
  options.clock = test::BenchSeconds;
  options.list_every = 0.02;
  options.lock_folder = bench.folder.path();
  options.tap = &reports;
  const DeviceRequest request = bench.link->request();
  bench.device.reset();
  bench.link = std::make_shared<LiveLink>(*bench.bus, request, options);
  auto logged = std::make_unique<LoggedDevice>(std::make_unique<LiveDevice>(bench.link, 0), log, 0);
  Device& device = *logged;
  const auto tick = [&] {
    const long taken = bench.link->counts().taken;
    test::AdvanceBench(1e-3);
    device.Read(test::BenchSeconds());
    device.HoldDeadMan(false);
    device.Command(glm::dvec3(0.0));
    WaitUntil([&] { return bench.link->counts().taken > taken || bench.link->opening() == 0; });
  };
  const auto until = [&](DeviceState state) {
    return WaitUntil([&] {
      tick();
      return device.state() == state;
    });
  };
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(until(DeviceState::kHoming));
    bench.link->AskHome();
    EXPECT_TRUE(until(DeviceState::kReady));
    for (int j = 0; j < 40; ++j) {
      board.SetCounters({j, -2 * j, 6000 + 3 * j, 0, 0, 0});
      if (j == 20) bench.usb.Send(kPath, Bytes(13));
      tick();
    }
    if (i == 1) break;
    bench.usb.Unplug(kPath);
    EXPECT_TRUE(until(DeviceState::kLost));
    bench.usb.Plug(test::WoodenArm(L"A", kPath));
  }
  // Both hold the link, whose threads push records.
  bench.link.reset();
  logged.reset();
  log.Close();
}

struct Recorded : testing::Test {
  Recorded() { Record(file); }
  test::TempFolder folder;
  const std::filesystem::path file = folder / "session.log";
};

using LogReplay = Recorded;

TEST(LogReplayOfAMinute, IsBitIdenticalOverThreeRuns) {
  // One minute at 1 kHz: a hand that passes the ends of the counters, and invalid reports.
  KnownDevice device;
  device.family = DeviceFamily::kWoodenHaptics;
  device.node.vendor = 0x1234;
  std::string refusal;
  const LogSource source{"wooden_haptics", "polhem_v1", "P", {DeviceRole::kScope, {}}};
  const auto driver = MakeDriver(device, source.model, refusal);
  ASSERT_TRUE(driver) << refusal;
  driver->Forget();
  LogRecord record;
  record.kind = LogKind::kOpened;
  record.vendor = device.node.vendor;
  std::string bytes = LogHead({&source, 1}), payload;
  Append(record, payload);
  std::mt19937 random(7);
  std::array<std::uint8_t, 14> report{};
  std::array<int, 6> counter{};
  long rejected = 0;
  for (int i = 0; i < 60000; ++i) {
    for (std::size_t j = 0; j < counter.size(); ++j) {
      counter[j] += static_cast<int>(random() % 9) - 3;  // mean drift upwards
      PutSigned(report, 2 * j, static_cast<std::int16_t>(counter[j]));
    }
    const std::size_t size = i % 97 == 0 ? 13 : 14;
    record.kind = LogKind::kReport;
    record.number = static_cast<std::uint64_t>(i) + 1;
    record.t_ns = 1'000'000ll * i;
    record.size = static_cast<std::uint8_t>(size);
    std::copy(report.begin(), report.end(), record.bytes.begin());
    record.news = driver->Take({report.data(), size});
    record.hands = 1;
    record.hand[0] = LoggedHandOf(driver->Hand(0));
    rejected += record.news == ReportNews::kRejected;
    Append(record, payload);
    if (i % 500 != 499) continue;
    bytes += LogBlock(payload, i == 499 ? 501 : 500);
    payload.clear();
  }
  EXPECT_GE(rejected, 60000 / 97);
  EXPECT_GT(counter[0], 32767) << "over the end";
  const ReportReplay first = ReplayReports(ParseDeviceLog(bytes), 0);
  EXPECT_EQ(first.reports, 60000);
  EXPECT_EQ(first.different, 0) << "first at " << first.first_different << " s";
  for (int run = 0; run < 2; ++run) {
    const ReportReplay again = ReplayReports(ParseDeviceLog(bytes), 0);
    ASSERT_EQ(again.hands.size(), first.hands.size());
    for (std::size_t i = 0; i < again.hands.size(); ++i)
      ASSERT_TRUE(IsSame(again.hands[i], first.hands[i])) << i;
  }
}

TEST_F(LogReplay, BytesThroughTheDriverGiveTheSameHands) {
  const DeviceLogContent log = ReadDeviceLog(file);
  EXPECT_EQ(log.missing, 0);
  EXPECT_TRUE(log.torn.empty());
  long opened = 0, asked = 0, rejected = 0, reports = 0;
  for (const LogRecord& record : log.records) {
    opened += record.kind == LogKind::kOpened;
    asked += record.kind == LogKind::kHomeAsked;
    reports += record.kind == LogKind::kReport;
    rejected += record.kind == LogKind::kReport && record.news == ReportNews::kRejected;
  }
  EXPECT_EQ(opened, 2);
  EXPECT_EQ(asked, 2);
  EXPECT_GE(rejected, 2) << "those of 13 bytes";
  const ReportReplay first = ReplayReports(log, 0);
  EXPECT_EQ(first.reports, reports);
  EXPECT_GE(first.reports, 80);
  EXPECT_EQ(first.different, 0) << "first at " << first.first_different << " s";
  for (int run = 0; run < 2; ++run) {
    const ReportReplay again = ReplayReports(ReadDeviceLog(file), 0);
    ASSERT_EQ(again.hands.size(), first.hands.size());
    for (std::size_t i = 0; i < again.hands.size(); ++i)
      ASSERT_TRUE(IsSame(again.hands[i], first.hands[i])) << i;
  }
}

TEST_F(LogReplay, DetectsADriverWithADifferentResult) {
  DeviceLogContent log = ReadDeviceLog(file);
  for (LogRecord& record : log.records)
    if (record.kind == LogKind::kReport && record.hand[0].sample.valid) {
      record.bytes[0] ^= 1;  // one count of the base
      EXPECT_EQ(ReplayReports(log, 0).different, 1);
      const double t = 1e-9 * static_cast<double>(record.t_ns);
      EXPECT_EQ(ReplayReports(log, 0).first_different, t);
      record.bytes[0] ^= 1;
      break;
    }
  EXPECT_EQ(ReplayReports(log, 0).different, 0);
  log.sources[0].model = "polhem_v1";
  EXPECT_GT(ReplayReports(log, 0).different, 0);
  log.sources[0].model = "polhem_v3";
  EXPECT_THROW(ReplayReports(log, 0), Error) << "it is not driven";
}

TEST_F(LogReplay, TicksAreARecordingOfHands) {
  const DeviceLogContent log = ReadDeviceLog(file);
  const auto rows = RecordingOf(log, file).rows;
  ASSERT_GT(rows.size(), 60u);
  EXPECT_EQ(rows.front().sample.t, 0);
  std::size_t next = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].device, DeviceRole::kInstrument);
    EXPECT_TRUE(rows[i].sample.valid);
    if (i > 0) {
      EXPECT_GT(rows[i].sample.t, rows[i - 1].sample.t);
    }
    while (next < log.records.size() &&
           (log.records[next].kind != LogKind::kTick ||
            log.records[next].sample.hip_in_device != rows[i].sample.hip_in_device))
      ++next;
  }
  EXPECT_LT(next, log.records.size()) << "each row is what a tick saw, in that order";
  // Its text can be read as a trace.
  EXPECT_EQ(ParseTrace(TraceText(rows)).size(), rows.size());
}

TEST_F(LogReplay, IsDistinguishedFromATraceByItsBytes) {
  const auto rows = RecordingOf(ReadDeviceLog(file)).rows;
  std::string notice;
  std::filesystem::copy(file, folder / "log.csv");
  EXPECT_EQ(TraceText(ReadRecording(folder / "log.csv", notice).rows), TraceText(rows));
  EXPECT_EQ(notice, "");
  WriteTrace(folder / "trace.log", rows);
  EXPECT_EQ(TraceText(ReadRecording(folder / "trace.log", notice).rows), TraceText(rows));
  EXPECT_EQ(notice, "");
}

TEST_F(LogReplay, ReplaysAnIncompleteLogWithANotice) {
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  std::string notice;
  const DeviceLogContent log = ReadDeviceLog(file);
  EXPECT_FALSE(log.torn.empty());
  ReadRecording(file, notice);
  EXPECT_NE(notice.find("was cut short"), std::string::npos) << notice;
}

TEST_F(LogReplay, RefusesALogWithoutAHand) {
  DeviceLogContent log = ReadDeviceLog(file);
  log.sources[0].roles = {};
  EXPECT_THROW(RecordingOf(log), Error);
}

TEST_F(LogReplay, SaysWhatAFileIsNotAndWhatToDo) {
  const auto sentence = [&](const std::string& bytes) {
    const std::filesystem::path other = folder / "other";
    WriteAtomically(other, bytes);
    std::string notice;
    try {
      ReadRecording(other, notice);
    } catch (const Error& fault) {
      return std::string(fault.what());
    }
    return std::string();
  };
  EXPECT_NE(sentence("").find("this file is empty"), std::string::npos);
  EXPECT_NE(sentence("Dear colleague,\n").find("neither a log nor a table of hands"),
            std::string::npos);
  EXPECT_NE(sentence("t,device,hip\n").find("the first line must be"), std::string::npos)
      << "a table of hands with another head";
  // An attempt that was cut off behind the head of its file, and a whole one.
  const std::string head = LogHead({});
  EXPECT_NE(sentence(head).find("cut short before anything was recorded"), std::string::npos);
  std::string payload;
  AppendBody(LogKind::kAttempt, 0, 0, "{}", payload);
  EXPECT_NE(sentence(head + LogBlock(payload, 1) + LogEnd(1)).find("arthroscene assess"),
            std::string::npos);
}

TEST_F(LogReplay, PlaysALogWithAPauseOfMoreThanAMinute) {
  DeviceLogContent log = ReadDeviceLog(file);
  for (LogRecord& record : log.records)
    if (record.sample.t > test::BenchSeconds() - 0.01) record.sample.t += 61;
  EXPECT_GT(RecordingOf(log).rows.back().sample.t, 61);
}

}  // namespace
}  // namespace arthro::simulation
