#include "simulation/device/log/log_format.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "simulation/core/error.h"

namespace arthro::simulation {
namespace {

const std::vector<LogSource> kSources = {
    {"wooden_haptics", "polhem_v1", "WH-A", {DeviceRole::kScope, std::nullopt}},
    {"razer_hydra", "", "é\"7", {DeviceRole::kInstrument, DeviceRole::kScope}},
    {"", "", "1", {}}};

// Bytes of version 1, without an end.
const std::string kOldHead = LogHead(kSources, 1);

LogRecord Tick(std::int64_t t_ns, std::uint64_t number) {
  LogRecord record;
  record.kind = LogKind::kTick;
  record.t_ns = t_ns;
  record.number = number;
  record.sample = {1e-9 * static_cast<double>(t_ns),
                   {0.1, -0.0, std::numeric_limits<double>::denorm_min()},
                   {0.5, -0.5, 0.5, 0.5},
                   0x80000001u,
                   true};
  record.command = {1.0 / 3, -3, std::nan("")};
  record.status = {DeviceState::kFault, DeviceTrouble::kSlowWrite, false};
  record.is_dead_man_held = true;
  return record;
}

LogRecord Report(std::int64_t t_ns, std::uint64_t number, std::uint8_t size) {
  LogRecord record;
  record.kind = LogKind::kReport;
  record.source = 1;
  record.t_ns = t_ns;
  record.number = number;
  record.news = ReportNews::kTaken;
  record.size = size;
  for (std::size_t i = 0; i < size; ++i) record.bytes[i] = static_cast<std::uint8_t>(7 * i + 1);
  record.hands = 2;
  record.hand[0].sample.hip_in_device = {0.25, 1e-300, -7};
  record.hand[1].is_homed = true;
  record.hand[1].rest = 0xdeadbeef;
  return record;
}

std::string BlockOf(std::initializer_list<LogRecord> records) {
  std::string payload;
  for (const LogRecord& record : records) Append(record, payload);
  return LogBlock(payload, static_cast<std::uint32_t>(records.size()));
}

std::string Sample() {
  LogRecord opened;
  opened.kind = LogKind::kOpened;
  opened.vendor = 0x16c0;
  opened.is_bluetooth = true;
  LogRecord asked;
  asked.kind = LogKind::kHomeAsked;
  asked.number = 1;
  asked.t_ns = 5;
  return kOldHead + BlockOf({opened, asked, Report(10, 0, 14)}) +
         BlockOf({Tick(20, 0), Report(30, 1, kReportRoom), Tick(40, 1)});
}

// Message of the refusal; empty where the log is accepted.
std::string Refusal(const std::string& bytes) {
  try {
    ParseDeviceLog(bytes);
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::kBadData);
    return error.what();
  }
}

TEST(LogFormat, ReadsBackToTheBit) {
  const DeviceLogContent log = ParseDeviceLog(Sample());
  EXPECT_EQ(log.sources, kSources);
  EXPECT_TRUE(log.torn.empty());
  EXPECT_EQ(log.missing, 0);
  ASSERT_EQ(log.records.size(), 6u);
  EXPECT_EQ(log.records[0].vendor, 0x16c0);
  EXPECT_TRUE(log.records[0].is_bluetooth);
  std::string again;
  for (const LogRecord& record : log.records) Append(record, again);
  std::string first;
  Append(log.records[0], first);
  Append(log.records[1], first);
  for (const LogRecord& record :
       {Report(10, 0, 14), Tick(20, 0), Report(30, 1, kReportRoom), Tick(40, 1)})
    Append(record, first);
  EXPECT_EQ(again, first);
  EXPECT_TRUE(std::isnan(log.records[3].command.z));
  EXPECT_TRUE(std::signbit(log.records[3].sample.hip_in_device.y));
  EXPECT_EQ(log.records[3].status.reason, DeviceTrouble::kSlowWrite);
}

TEST(LogFormat, TheLargestRecordFitsKLargestRecord) {
  LogRecord largest = Report(0, 0, kReportRoom);
  std::string payload;
  Append(largest, payload);
  EXPECT_LE(payload.size(), kLargestRecord);
}

TEST(LogFormat, ATornTailLosesOnlyTheLastBlockAtEveryByte) {
  const std::string head = kOldHead, first = BlockOf({Tick(20, 0), Tick(30, 1)}),
                    last = BlockOf({Tick(40, 2), Report(50, 0, 64)}), whole = head + first + last;
  for (std::size_t size = (head + first).size(); size < whole.size(); ++size) {
    const DeviceLogContent log = ParseDeviceLog(whole.substr(0, size));
    ASSERT_EQ(log.records.size(), 2u) << size;
    if (size == (head + first).size())
      EXPECT_TRUE(log.torn.empty()) << "nobody can know";
    else
      ASSERT_NE(log.torn.find("was cut short"), std::string::npos) << size;
  }
  // A file system may have allocated space that was never written.
  for (const std::size_t zeros : {1, 16, 4096}) {
    const DeviceLogContent log = ParseDeviceLog(head + first + std::string(zeros, '\0'));
    EXPECT_EQ(log.records.size(), 2u);
    EXPECT_FALSE(log.torn.empty());
  }
  std::string half = whole;
  std::fill(half.end() - 40, half.end(), '\0');
  EXPECT_EQ(ParseDeviceLog(half).records.size(), 2u);
  EXPECT_FALSE(ParseDeviceLog(half).torn.empty());
}

TEST(LogFormat, RefusesAnIncompleteHead) {
  const std::string head = kOldHead;
  for (std::size_t size = 1; size < head.size(); ++size)
    ASSERT_NE(Refusal(head.substr(0, size)), "") << size;
  EXPECT_EQ(Refusal(head), "");
}

TEST(LogFormat, DetectsEveryFlippedBit) {
  const std::string whole = Sample();
  for (std::size_t byte = 0; byte < whole.size(); ++byte)
    for (int bit = 0; bit < 8; ++bit) {
      std::string flipped = whole;
      flipped[byte] = static_cast<char>(flipped[byte] ^ 1 << bit);
      if (!Refusal(flipped).empty()) continue;
      // Only damage in the last block may return the blocks before, with a notice.
      const DeviceLogContent log = ParseDeviceLog(flipped);
      ASSERT_EQ(log.records.size(), 3u) << byte;
      ASSERT_FALSE(log.torn.empty()) << byte;
    }
}

TEST(LogFormat, RefusesOtherFilesWithOneSentence) {
  EXPECT_NE(Refusal("").find("empty"), std::string::npos);
  EXPECT_NE(Refusal("t,device,hip_x").find("no device log"), std::string::npos);
  std::string other = Sample();
  for (const char version : {0, 6}) {
    other[8] = version;
    EXPECT_NE(Refusal(other).find("and 1 to 5 are read here"), std::string::npos);
  }
}

TEST(LogFormat, RefusesHugeLengthsBeforeAllocating) {
  const auto put = [](std::string& bytes, std::size_t at, std::uint32_t value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
  };
  const std::string head = kOldHead;
  // A block with a too large size and a valid checksum.
  std::string empty = LogBlock("", 0);
  for (const std::uint32_t size : {std::uint32_t{kLargestBlock} + 1, 0x7fffffffu, 0xffffffffu}) {
    std::string claims = LogBlock(std::string(16, 'x'), 1);
    put(claims, 0, size);
    EXPECT_NE(Refusal(head + claims + empty).find("damaged"), std::string::npos);
  }
  // More records than there are, incomplete ones, and a record longer than its block.
  EXPECT_NE(Refusal(head + LogBlock("", 0xffffffffu) + empty).find("cannot be"), std::string::npos);
  std::string payload;
  Append(Tick(1, 0), payload);
  payload[2] = payload[3] = '\xff';
  EXPECT_NE(Refusal(head + LogBlock(payload, 1) + empty).find("cannot be"), std::string::npos);
  // A report with too many bytes; an unknown hand, state, source and kind.
  const auto broken = [&](const LogRecord& record, std::size_t at) {
    std::string bytes;
    Append(record, bytes);
    bytes[at] = '\xff';
    return Refusal(head + LogBlock(bytes, 1) + empty);
  };
  for (const std::size_t at : {0, 1, 20, 21, 22}) {
    EXPECT_NE(broken(Report(1, 0, 14), at).find("cannot be"), std::string::npos) << at;
  }
  for (const std::size_t at : {0, 1, 2, 20}) {
    EXPECT_NE(broken(Tick(1, 0), at).find("cannot be"), std::string::npos) << at;
  }
  // Bytes after the last record.
  EXPECT_NE(Refusal(head + LogBlock("xyz", 0) + empty).find("longer"), std::string::npos);
}

TEST(LogFormat, CountsDroppedRecords) {
  const DeviceLogContent log =
      ParseDeviceLog(kOldHead + BlockOf({Tick(1, 2), Tick(2, 3), Report(3, 1, 14)}));
  EXPECT_EQ(log.missing, 3) << "ticks 0 and 1, report 0";
}

// Bytes of version 2.
std::string Ended(std::uint64_t pushed) {
  return LogHead(kSources) + BlockOf({Tick(1, 0), Tick(2, 1), Report(3, 0, 14)}) + LogEnd(pushed);
}

TEST(LogFormat, TheEndHasConstantBytes) {
  const unsigned char golden[] = {
      0x1c, 0, 0, 0, 1, 0, 0, 0, 0x25, 0x5a, 0xfe, 0xd8, 0x33, 0x04, 0x9d, 0x4a,  // block
      5,    0, 8, 0, 0, 0, 0, 0, 0,    0,    0,    0,    0,    0,    0,    0,     // record
      0,    0, 0, 0, 7, 0, 0, 0, 0,    0,    0,    0};
  const std::string end = LogEnd(7);
  ASSERT_EQ(end.size(), sizeof golden);
  EXPECT_EQ(std::memcmp(end.data(), golden, sizeof golden), 0) << testing::PrintToString(end);
}

TEST(LogFormat, TheEndCountsRecordsDroppedAfterTheLastOne) {
  const DeviceLogContent whole = ParseDeviceLog(Ended(3));
  EXPECT_EQ(whole.records.size(), 3u) << "the end is none of them";
  EXPECT_EQ(whole.missing, 0);
  EXPECT_EQ(whole.torn, "");
  EXPECT_EQ(ParseDeviceLog(Ended(10)).missing, 7);
  EXPECT_EQ(ParseDeviceLog(Ended(10)).torn, "");
  EXPECT_NE(Refusal(Ended(2)).find("counts fewer records than there are"), std::string::npos);
}

TEST(LogFormat, ReportsAMissingEndOfVersion2AtEveryByte) {
  const std::string whole = Ended(5);
  const std::size_t without = whole.size() - LogEnd(5).size();
  for (std::size_t size = without; size < whole.size(); ++size) {
    const DeviceLogContent log = ParseDeviceLog(whole.substr(0, size));
    ASSERT_EQ(log.records.size(), 3u) << size;
    ASSERT_EQ(log.missing, 0) << "nobody can know";
    ASSERT_NE(log.torn.find(size == without ? "has no end" : "was cut short"), std::string::npos)
        << size << ": " << log.torn;
  }
}

TEST(LogFormat, RefusesRecordsAfterTheEnd) {
  EXPECT_NE(Refusal(Ended(3) + BlockOf({Tick(9, 2)})).find("comes after the end"),
            std::string::npos);
  LogRecord end;
  end.kind = LogKind::kEnd;
  EXPECT_NE(Refusal(LogHead(kSources) + BlockOf({Tick(1, 0), end})).find("an end among"),
            std::string::npos);
}

LogRecord Wish(std::int64_t t_ns, std::uint64_t number, double view_angle) {
  LogRecord record;
  record.kind = LogKind::kWish;
  record.t_ns = t_ns;
  record.number = number;
  record.wish = {view_angle, -0.018, 4, 7};
  record.wish.is_complete = true;
  record.wish.is_head_upright = true;
  record.wish.head_turn = -0.75;
  record.wish.disturbance = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  record.wish.disturbance_seed = -12;
  record.wish.mount[1] = {{0.1, 0.2, 0.3}, {0.5, 0.5, -0.5, 0.5}, 0.21};
  return record;
}

LogRecord Option(std::int64_t t_ns, std::uint64_t number, std::string_view name, double value) {
  LogRecord record;
  record.kind = LogKind::kOption;
  record.t_ns = t_ns;
  record.number = number;
  std::copy(name.begin(), name.end(), record.option.name.begin());
  record.option.value = value;
  return record;
}

TEST(LogFormat, WishComesBackAsItWasWritten) {
  const std::string head = LogHead(kSources);
  const auto log =
      ParseDeviceLog(head + BlockOf({Tick(3, 0), Wish(4, 0, 1.25), Wish(9, 1, 0.5)}) + LogEnd(3));
  ASSERT_EQ(log.records.size(), 3u);
  EXPECT_EQ(log.missing, 0) << "wishes are numbered apart from ticks";
  EXPECT_EQ(log.records[1].wish, Wish(4, 0, 1.25).wish);
  EXPECT_EQ(log.records[2].wish.view_angle, 0.5);
}

TEST(LogFormat, OptionComesBackAsItWasWritten) {
  const auto log = ParseDeviceLog(
      LogHead(kSources) + BlockOf({Option(3, 0, "stiffness", 240), Wish(4, 1, 0.5)}) + LogEnd(2));
  EXPECT_EQ(log.missing, 0) << "wishes and options are numbered together";
  EXPECT_EQ(log.records.at(0).option, Option(3, 0, "stiffness", 240).option);
  const std::string nan = BlockOf({Option(3, 0, "stiffness", std::nan(""))});
  EXPECT_THROW(ParseDeviceLog(LogHead(kSources) + nan + LogEnd(1)), Error);
}

TEST(LogFormat, RecordsOfAnAttemptComeBackBesideTheOthers) {
  std::string payload;
  AppendBody(LogKind::kFrame, 7, 0, "frame", payload);
  Append(Tick(8, 0), payload);
  AppendBody(LogKind::kEvent, 9, 1, "", payload);
  const auto log = ParseDeviceLog(LogHead(kSources) + LogBlock(payload, 3) + LogEnd(3));
  ASSERT_EQ(log.attempt.size(), 2u);
  EXPECT_EQ(log.records.size(), 1u);
  EXPECT_EQ(log.missing, 0);
  EXPECT_EQ(log.attempt[0].kind, LogKind::kFrame);
  EXPECT_EQ(log.attempt[0].t_ns, 7);
  EXPECT_EQ(log.bodies.substr(log.attempt[0].begin, log.attempt[0].size), "frame");
  EXPECT_EQ(log.attempt[1].size, 0u);
}

TEST(LogFormat, RefusesAWishThatIsNoNumber) {
  EXPECT_THROW(ParseDeviceLog(LogHead(kSources) + BlockOf({Wish(4, 0, std::nan(""))}) + LogEnd(1)),
               Error);
}

TEST(LogFormat, WishOfVersionThreeIsReadAsIncomplete) {
  // A wish of version 3 ended after the number of resets.
  std::string payload = BlockOf({Wish(4, 0, 1.25)}).substr(16);
  constexpr std::size_t kHead = 20, kBody = 8 + 8 + 1 + 4;
  payload.resize(kHead + kBody);
  payload[2] = static_cast<char>(kBody);
  payload[3] = 0;
  const auto log = ParseDeviceLog(LogHead(kSources, 3) + LogBlock(payload, 1) + LogEnd(1));
  EXPECT_EQ(log.records.at(0).wish, (LoggedWish{1.25, -0.018, 4, 7}));
}

TEST(LogFormat, VersionBeforeWishesCanBeRead) {
  const auto log = ParseDeviceLog(LogHead(kSources, 2) + BlockOf({Tick(3, 0)}) + LogEnd(1));
  EXPECT_EQ(log.records.size(), 1u);
  EXPECT_EQ(log.torn, "");
}

}  // namespace
}  // namespace arthro::simulation
