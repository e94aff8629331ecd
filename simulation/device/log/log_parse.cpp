// Reading of device logs of all versions, damaged ones included.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/json_text.h"
#include "simulation/device/log/log_format.h"
#include "simulation/device/log/log_layout.h"
#include "simulation/device/trace_io.h"

namespace arthro::simulation {
namespace {

// Reads values from the front of bytes; with too few bytes it fails from then on.
class Taker {
 public:
  explicit Taker(std::string_view bytes) : bytes_(bytes) {}
  bool is_good() const { return is_good_; }
  std::size_t left() const { return bytes_.size(); }

  std::string_view Bytes(std::size_t count) {
    is_good_ = is_good_ && count <= bytes_.size();
    if (!is_good_) return {};
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  template <class T>
  T Take() {
    T value{};
    if (const std::string_view taken = Bytes(sizeof value); is_good_)
      std::memcpy(&value, taken.data(), sizeof value);
    return value;
  }
  bool Flag() {
    const auto flag = Take<std::uint8_t>();
    is_good_ = is_good_ && flag <= 1;
    return flag == 1;
  }
  template <class Enum>
  Enum ReadEnum(Enum last) {
    const auto value = Take<std::uint8_t>();
    is_good_ = is_good_ && value <= static_cast<std::uint8_t>(last);
    return static_cast<Enum>(value);
  }
  glm::dvec3 Vector() {
    glm::dvec3 v;
    for (int i = 0; i < 3; ++i) v[i] = Take<double>();
    return v;
  }
  glm::dquat Quaternion() {
    glm::dquat q;
    for (double* part : {&q.w, &q.x, &q.y, &q.z}) *part = Take<double>();
    return q;
  }
  DeviceSample Sample() {
    DeviceSample sample;
    sample.t = Take<double>();
    sample.hip_in_device = Vector();
    sample.handle_in_device = Quaternion();
    sample.buttons = Take<std::uint32_t>();
    sample.valid = Flag();
    return sample;
  }

 private:
  std::string_view bytes_;
  bool is_good_ = true;
};

// Reads the wish of a log of `version`. Returns false for impossible values.
bool TakeWish(Taker& body, std::uint32_t version, LoggedWish& wish) {
  wish.view_angle = body.Take<double>();
  wish.incision_spacing = body.Take<double>();
  wish.instrument = body.Take<std::uint8_t>();
  wish.resets = body.Take<std::uint32_t>();
  double sum = wish.view_angle + wish.incision_spacing;
  wish.is_complete = version >= kCompleteWishes;
  if (wish.is_complete) {
    wish.is_head_upright = body.Flag();
    sum += wish.head_turn = body.Take<double>();
    for (double& strength : wish.disturbance) sum += strength = body.Take<double>();
    wish.disturbance_seed = body.Take<std::int32_t>();
    for (LoggedMount& mount : wish.mount) {
      mount.pivot = body.Vector();
      const glm::dquat& q = mount.portal_from_device = body.Quaternion();
      mount.rod_length = body.Take<double>();
      sum += mount.pivot.x + mount.pivot.y + mount.pivot.z + q.w + q.x + q.y + q.z;
      sum += mount.rod_length;
    }
  }
  return std::isfinite(sum);
}

// True for records of an attempt.
bool IsBody(LogKind kind) {
  return kind == LogKind::kAttempt || kind == LogKind::kFrame || kind == LogKind::kEvent;
}

// Takes a record of an attempt into `log` where the next one is such. Returns false otherwise.
bool TakeBody(Taker& taker, DeviceLogContent& log) {
  Taker ahead = taker;
  LoggedBody body;
  body.kind = static_cast<LogKind>(ahead.Take<std::uint8_t>());
  ahead.Take<std::uint8_t>();
  const auto size = ahead.Take<std::uint16_t>();
  body.t_ns = ahead.Take<std::int64_t>();
  ahead.Take<std::uint64_t>();
  const std::string_view bytes = ahead.Bytes(size);
  if (!ahead.is_good() || !IsBody(body.kind)) return false;
  body.begin = log.bodies.size();
  body.size = size;
  log.bodies += bytes;
  log.attempt.push_back(body);
  taker = ahead;
  return true;
}

// Takes the payload of a piece's block into `log`. Returns false for one without a time.
bool TakePiece(std::string_view payload, DeviceLogContent& log) {
  Taker taker(payload);
  LoggedBody piece;
  piece.kind = LogKind::kPiece;
  piece.t_ns = taker.Take<std::int64_t>();
  if (!taker.is_good()) return false;
  piece.begin = log.bodies.size();
  piece.size = taker.left();
  log.bodies += taker.Bytes(taker.left());
  log.pieces.push_back(piece);
  return true;
}

// Decodes the body of a record. Returns false for impossible values.
bool TakeRecord(Taker& taker, std::size_t sources, std::uint32_t version, LogRecord& record) {
  record.kind = static_cast<LogKind>(taker.Take<std::uint8_t>());
  record.source = taker.Take<std::uint8_t>();
  const auto size = taker.Take<std::uint16_t>();
  record.t_ns = taker.Take<std::int64_t>();
  record.number = taker.Take<std::uint64_t>();
  Taker body(taker.Bytes(size));
  const bool is_known = record.kind == LogKind::kEnd || record.source < sources;
  if (!taker.is_good() || !is_known) return false;
  switch (record.kind) {
    case LogKind::kOpened:
      record.vendor = body.Take<std::uint16_t>();
      record.is_bluetooth = body.Flag();
      break;
    case LogKind::kHomeAsked:
      break;
    case LogKind::kReport: {
      record.news = body.ReadEnum(ReportNews::kTaken);
      record.size = body.Take<std::uint8_t>();
      record.hands = body.Take<std::uint8_t>();
      if (record.size > record.bytes.size() || record.hands > record.hand.size()) return false;
      const std::string_view bytes = body.Bytes(record.size);
      std::copy(bytes.begin(), bytes.end(), record.bytes.begin());
      for (std::size_t i = 0; i < record.hands; ++i) {
        record.hand[i].sample = body.Sample();
        record.hand[i].is_homed = body.Flag();
        record.hand[i].rest = body.Take<std::uint32_t>();
      }
      break;
    }
    case LogKind::kTick:
      record.tick_hand = body.Take<std::uint8_t>();
      record.sample = body.Sample();
      record.command = body.Vector();
      record.status.state = body.ReadEnum(DeviceState::kLost);
      record.status.reason = body.ReadEnum(DeviceTrouble::kProtected);
      record.status.must_release = body.Flag();
      record.is_dead_man_held = body.Flag();
      if (record.tick_hand >= record.hand.size()) return false;
      break;
    case LogKind::kEnd:
      record.pushed = body.Take<std::uint64_t>();
      break;
    case LogKind::kWish:
      if (!TakeWish(body, version, record.wish)) return false;
      break;
    case LogKind::kOption: {
      const std::string_view name = body.Bytes(body.Take<std::uint8_t>());
      if (name.size() >= record.option.name.size()) return false;
      std::copy(name.begin(), name.end(), record.option.name.begin());
      record.option.value = body.Take<double>();
      if (!std::isfinite(record.option.value)) return false;
      break;
    }
    default:
      return false;
  }
  return body.is_good() && body.left() == 0;
}

// Throws for a head that is not one of this version.
std::vector<LogSource> SourcesIn(std::string_view text, std::uint32_t version) {
  std::vector<LogSource> sources;
  const auto json = ParseJson(text, Code::kBadData);
  if (json.contains("version") != (version >= kVersionInHead) ||
      json.value("version", version) != version)
    throw Error(Code::kBadData, "the version in the head is another");
  for (const auto& each : json.at("sources")) {
    LogSource& source = sources.emplace_back();
    each.at("family").get_to(source.family);
    each.at("model").get_to(source.model);
    each.at("serial").get_to(source.serial);
    const auto& roles = each.at("roles");
    for (std::size_t i = 0; i < source.roles.size(); ++i)
      for (const DeviceRole role : kDeviceRoles)
        if (roles.at(i) == ToString(role)) source.roles[i] = role;
  }
  return sources;
}

constexpr auto kMostMissing = static_cast<std::uint64_t>(std::numeric_limits<long>::max());

// Counts dropped records: the numbers of a channel rise by one. Numbers of a stranger's log may
// repeat or be huge.
long CountMissing(std::span<const LogRecord> records) {
  struct Channel {
    std::uint64_t end = 0, count = 0;
  };
  std::map<int, Channel> channels;
  for (const LogRecord& record : records) {
    const bool is_wish = record.kind == LogKind::kWish || record.kind == LogKind::kOption;
    const int part = record.kind == LogKind::kTick ? 1 + record.tick_hand : is_wish ? 3 : 0;
    Channel& channel = channels[record.source * 4 + part];
    channel.end = std::max(channel.end, record.number + 1);
    ++channel.count;
  }
  std::uint64_t missing = 0;
  for (const auto& [key, channel] : channels) {
    const std::uint64_t gap = channel.end - std::min(channel.end, channel.count);
    missing += std::min(gap, kMostMissing - missing);
  }
  return static_cast<long>(missing);
}

}  // namespace

bool IsDeviceLog(std::string_view bytes) noexcept { return bytes.starts_with(kLogMagic); }

DeviceLogContent ParseDeviceLog(std::string_view bytes, const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& what) { throw Error(Code::kBadData, what, file); };
  if (bytes.empty()) refuse("this is empty; a device log was to be here, so record it again");
  if (!IsDeviceLog(bytes)) refuse("this is no device log; give a file that was recorded as one");
  Taker taker(bytes.substr(kLogMagic.size()));
  const auto version = taker.Take<std::uint32_t>();
  if (taker.is_good() && (version < kOldestLogVersion || version > kLogVersion))
    refuse(
        fmt::format("this device log has version {}, and {} to {} are read here; use the program "
                    "that recorded it",
                    version, kOldestLogVersion, kLogVersion));
  DeviceLogContent log;
  std::optional<std::uint64_t> pushed;  // set once the end was read
  bool has_sources = false;
  while (taker.left() > 0 || !has_sources) {
    const std::size_t at = bytes.size() - taker.left();
    const std::string where = fmt::format("the block at byte {}", at);
    const std::string_view head = taker.Bytes(kBlockHead);
    std::string_view payload;
    std::uint32_t records = 0;
    bool is_whole = taker.is_good();
    if (is_whole && bytes.find_first_not_of('\0', at) == std::string_view::npos) is_whole = false;
    if (is_whole) {
      Taker fields(head);
      const auto size = fields.Take<std::uint32_t>();
      records = fields.Take<std::uint32_t>();
      const auto checksum = fields.Take<std::uint32_t>();
      if (fields.Take<std::uint32_t>() != Checksum(head.substr(0, 12)) || size > kLargestBlock)
        refuse(where + " is damaged; take another copy of the file, or record it again");
      payload = taker.Bytes(size);
      is_whole = taker.is_good() && Checksum(payload) == checksum;
      const bool is_piece =
          version >= kHasPieces && (records & kPieceBit) != 0 && has_sources && !pushed;
      if (is_piece && taker.is_good()) {
        if (!is_whole || !TakePiece(payload, log)) ++log.damaged_pieces;
        continue;
      }
      if (!is_whole && taker.is_good() && taker.left() > 0)
        refuse(where + " is damaged; take another copy of the file, or record it again");
    }
    if (!is_whole) {
      if (!has_sources) refuse("this device log ends in its head; record it again");
      log.torn =
          fmt::format("the recording was cut short: {} of {} bytes are whole", at, bytes.size());
      break;
    }
    if (!has_sources) {
      try {
        log.sources = SourcesIn(payload, version);
      } catch (const std::exception&) {  // invalid JSON, or JSON of another form
        refuse("the head of this device log cannot be; record it again");
      }
      has_sources = true;
      continue;
    }
    if (pushed) refuse(where + " comes after the end of this device log; record it again");
    Taker inside(payload);
    for (std::uint32_t i = 0; i < records; ++i)
      if (!TakeBody(inside, log) &&
          !TakeRecord(inside, log.sources.size(), version, log.records.emplace_back()))
        refuse(
            fmt::format("{} holds a record that cannot be, number {}; use the program that "
                        "recorded it",
                        where, i));
    if (inside.left() > 0) refuse(where + " is longer than its records; record it again");
    if (records == 1 && !log.records.empty() && log.records.back().kind == LogKind::kEnd) {
      pushed = log.records.back().pushed;
      log.records.pop_back();
    }
  }
  if (std::ranges::any_of(log.records,
                          [](const LogRecord& record) { return record.kind == LogKind::kEnd; }))
    refuse("this device log has an end among its records; use the program that recorded it");
  std::stable_sort(log.records.begin(), log.records.end(),
                   [](const LogRecord& a, const LogRecord& b) { return a.t_ns < b.t_ns; });
  log.missing = CountMissing(log.records);
  if (pushed) {
    const std::uint64_t kept = log.records.size() + log.attempt.size();
    if (*pushed < kept + static_cast<std::uint64_t>(log.missing))
      refuse("the end of this device log counts fewer records than there are; record it again");
    log.missing = static_cast<long>(std::min(*pushed - kept, kMostMissing));
  } else if (version > kOldestLogVersion && log.torn.empty()) {
    log.torn =
        "the recording has no end: who recorded it did not come to close it, and what came "
        "last may be missing";
  }
  return log;
}

DeviceLogContent ReadDeviceLog(const std::filesystem::path& file) {
  return ParseDeviceLog(ReadWholeFile(file), file);
}

}  // namespace arthro::simulation
