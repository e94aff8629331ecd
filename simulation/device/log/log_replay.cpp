#include "simulation/device/log/log_replay.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/device/driver/drivers.h"

namespace arthro::simulation {
namespace {

std::unique_ptr<DeviceDriver> DriverOf(const LogSource& source, const LogRecord& opened) {
  const auto family = DeviceFamilyFromString(source.family);
  KnownDevice device;
  std::string refusal = fmt::format("there is no family \"{}\"", source.family);
  std::unique_ptr<DeviceDriver> driver;
  if (family) {
    device.family = *family;
    device.node.vendor = opened.vendor;
    device.node.is_bluetooth = opened.is_bluetooth;
    driver = MakeDriver(device, source.model, refusal);
  }
  if (!driver)
    throw Error(Code::kBadData,
                fmt::format("device {} cannot be played again: {}", source.serial, refusal));
  driver->Forget();
  return driver;
}

}  // namespace

ReportReplay ReplayReports(const DeviceLogContent& log, int source) {
  ReportReplay replay;
  std::unique_ptr<DeviceDriver> driver;
  for (const LogRecord& record : log.records) {
    if (record.source != source) continue;
    if (record.kind == LogKind::kOpened)
      driver = DriverOf(log.sources[static_cast<std::size_t>(source)], record);
    if (!driver) continue;
    if (record.kind == LogKind::kHomeAsked) driver->AskHome();
    if (record.kind != LogKind::kReport) continue;
    const ReportNews news = driver->Take({record.bytes.data(), record.size});
    bool is_same = news == record.news && driver->hands() == record.hands;
    for (int hand = 0; hand < driver->hands(); ++hand) {
      const LoggedHand now = LoggedHandOf(driver->Hand(hand));
      is_same = is_same && IsSame(now, record.hand[static_cast<std::size_t>(hand)]);
      replay.hands.push_back(now);
    }
    ++replay.reports;
    if (is_same) continue;
    if (replay.different == 0) replay.first_different = 1e-9 * static_cast<double>(record.t_ns);
    ++replay.different;
  }
  return replay;
}

namespace {

// A table whose first columns are those of a trace; its reader says what else is wrong with it.
bool LooksLikeTrace(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF", kBegin = "t,device";
  return text.substr(0, kBegin.size()) == kBegin ||
         text.substr(0, kByteOrderMark.size() + kBegin.size()) ==
             std::string(kByteOrderMark) + std::string(kBegin);
}

std::string WhyNoHands(const DeviceLogContent& log) {
  if (!log.attempt.empty())
    return "this is an attempt at an exercise, which holds no hands to replay; look back at it in "
           "the window, or give it to `arthroscene assess`";
  if (!log.torn.empty())
    return "this recording was cut short before anything was recorded; take another copy of the "
           "file, or record it again";
  return "this device log has no hand in it: no device with a role was ready; record it again";
}

}  // namespace

Recording RecordingOf(const DeviceLogContent& log, const std::filesystem::path& file) {
  Recording recording;
  std::vector<TraceRow>& rows = recording.rows;
  std::array<double, 2> newest{-1, -1};  // s, by role; a sample that is read again has the same t
  for (const LogRecord& record : log.records) {
    if (record.kind != LogKind::kTick || !record.sample.valid) continue;
    const auto role = log.sources[record.source].roles[record.tick_hand];
    if (!role) continue;
    double& t = newest[static_cast<std::size_t>(*role)];
    if (!(record.sample.t > t)) continue;
    const glm::dvec3& hip = record.sample.hip_in_device;
    const glm::dquat& q = record.sample.handle_in_device;
    if (!std::isfinite(hip.x + hip.y + hip.z + q.w + q.x + q.y + q.z + record.sample.t))
      throw Error(Code::kBadData, "this device log has a hand that is no number; record it again",
                  file);
    t = record.sample.t;
    rows.push_back({*role, record.sample});
  }
  if (rows.empty()) throw Error(Code::kBadData, WhyNoHands(log), file);
  std::stable_sort(rows.begin(), rows.end(),
                   [](const TraceRow& a, const TraceRow& b) { return a.sample.t < b.sample.t; });
  const double begin = rows.front().sample.t;
  for (TraceRow& row : rows) row.sample.t -= begin;
  for (const LogRecord& record : log.records) {
    const double t = 1e-9 * static_cast<double>(record.t_ns) - begin;
    if (record.kind == LogKind::kWish) recording.wishes.push_back({t, record.wish});
    if (record.kind == LogKind::kOption) recording.options.push_back({t, record.option});
  }
  return recording;
}

Recording ReadRecording(const std::filesystem::path& file, std::string& notice) {
  const std::string bytes = ReadWholeFile(file);
  notice.clear();
  if (!IsDeviceLog(bytes)) {
    if (!LooksLikeTrace(bytes))
      throw Error(Code::kBadData,
                  bytes.empty()
                      ? "this file is empty, so it holds no recording; name another one"
                      : "this is no recording of the program: neither a log nor a table of hands "
                        "(TRACE.csv); name another file",
                  file);
    return {ParseTrace(bytes, file)};
  }
  const DeviceLogContent log = ParseDeviceLog(bytes, file);
  if (!log.torn.empty()) notice = file.string() + ": " + log.torn;
  if (log.missing > 0)
    notice += fmt::format("{}{}: {} records were dropped when it was recorded",
                          notice.empty() ? "" : "; ", file.string(), log.missing);
  return RecordingOf(log, file);
}

}  // namespace arthro::simulation
