#include "simulation/device/log/log_format.h"

#include <array>
#include <bit>
#include <cstring>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "simulation/device/log/log_layout.h"
#include "simulation/device/trace_io.h"

namespace arthro::simulation {
namespace {

template <class T>
void Put(std::string& bytes, const T& value) {
  static_assert(std::is_arithmetic_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}
void Put(std::string& bytes, const glm::dvec3& v) {
  for (int i = 0; i < 3; ++i) Put(bytes, v[i]);
}
void Put(std::string& bytes, const glm::dquat& q) {
  for (const double part : {q.w, q.x, q.y, q.z}) Put(bytes, part);
}
void Put(std::string& bytes, const DeviceSample& sample) {
  Put(bytes, sample.t);
  Put(bytes, sample.hip_in_device);
  Put(bytes, sample.handle_in_device);
  Put(bytes, sample.buttons);
  Put(bytes, static_cast<std::uint8_t>(sample.valid));
}

}  // namespace

LoggedHand LoggedHandOf(const HandReading& reading) noexcept {
  LoggedHand hand{reading.sample, reading.is_homed, 0};
  hand.sample.t = 0;
  std::array<double, 9> rest;
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = static_cast<int>(i);
    rest[i] = reading.push[axis], rest[3 + i] = reading.turn[axis];
    rest[6 + i] = reading.joints[axis];
  }
  hand.rest = Checksum({reinterpret_cast<const char*>(rest.data()), sizeof rest});
  return hand;
}

bool IsSame(const LoggedHand& a, const LoggedHand& b) noexcept {
  const auto bits = [](const LoggedHand& hand) {
    const glm::dvec3& hip = hand.sample.hip_in_device;
    const glm::dquat& q = hand.sample.handle_in_device;
    return std::bit_cast<std::array<std::uint64_t, 7>>(
        std::array{hip.x, hip.y, hip.z, q.w, q.x, q.y, q.z});
  };
  return bits(a) == bits(b) && a.sample.buttons == b.sample.buttons &&
         a.sample.valid == b.sample.valid && a.is_homed == b.is_homed && a.rest == b.rest;
}

void Append(const LogRecord& record, std::string& payload) {
  const std::size_t begin = payload.size();
  Put(payload, static_cast<std::uint8_t>(record.kind));
  Put(payload, record.source);
  Put(payload, std::uint16_t{0});
  Put(payload, record.t_ns);
  Put(payload, record.number);
  switch (record.kind) {
    case LogKind::kOpened:
      Put(payload, record.vendor);
      Put(payload, static_cast<std::uint8_t>(record.is_bluetooth));
      break;
    case LogKind::kHomeAsked:
      break;
    case LogKind::kReport:
      Put(payload, static_cast<std::uint8_t>(record.news));
      Put(payload, record.size);
      Put(payload, record.hands);
      payload.append(reinterpret_cast<const char*>(record.bytes.data()), record.size);
      for (std::size_t i = 0; i < record.hands; ++i) {
        Put(payload, record.hand[i].sample);
        Put(payload, static_cast<std::uint8_t>(record.hand[i].is_homed));
        Put(payload, record.hand[i].rest);
      }
      break;
    case LogKind::kTick:
      Put(payload, record.tick_hand);
      Put(payload, record.sample);
      Put(payload, record.command);
      Put(payload, static_cast<std::uint8_t>(record.status.state));
      Put(payload, static_cast<std::uint8_t>(record.status.reason));
      Put(payload, static_cast<std::uint8_t>(record.status.must_release));
      Put(payload, static_cast<std::uint8_t>(record.is_dead_man_held));
      break;
    case LogKind::kEnd:
      Put(payload, record.pushed);
      break;
    case LogKind::kWish:
      Put(payload, record.wish.view_angle);
      Put(payload, record.wish.incision_spacing);
      Put(payload, record.wish.instrument);
      Put(payload, record.wish.resets);
      Put(payload, static_cast<std::uint8_t>(record.wish.is_head_upright));
      Put(payload, record.wish.head_turn);
      for (const double strength : record.wish.disturbance) Put(payload, strength);
      Put(payload, record.wish.disturbance_seed);
      for (const LoggedMount& mount : record.wish.mount) {
        Put(payload, mount.pivot);
        Put(payload, mount.portal_from_device);
        Put(payload, mount.rod_length);
      }
      break;
    case LogKind::kOption: {
      const std::string_view name(record.option.name.data());
      Put(payload, static_cast<std::uint8_t>(name.size()));
      payload.append(name);
      Put(payload, record.option.value);
      break;
    }
    case LogKind::kAttempt:
    case LogKind::kFrame:
    case LogKind::kEvent:
    case LogKind::kPiece:
      break;  // AppendBody and PieceBlock write them
  }
  const auto size = static_cast<std::uint16_t>(payload.size() - begin - kRecordHead);
  std::memcpy(payload.data() + begin + 2, &size, sizeof size);
}

void AppendBody(LogKind kind, std::int64_t t_ns, std::uint64_t number, std::string_view body,
                std::string& payload) {
  Put(payload, static_cast<std::uint8_t>(kind));
  Put(payload, std::uint8_t{0});
  Put(payload, static_cast<std::uint16_t>(body.size()));
  Put(payload, t_ns);
  Put(payload, number);
  payload.append(body);
}

std::string LogBlock(std::string_view payload, std::uint32_t records) {
  std::string block;
  block.reserve(kBlockHead + payload.size());
  Put(block, static_cast<std::uint32_t>(payload.size()));
  Put(block, records);
  Put(block, Checksum(payload));
  Put(block, Checksum(block));
  return block.append(payload);
}

std::string PieceBlock(std::int64_t t_ns, std::string_view piece) {
  std::string payload;
  payload.reserve(sizeof t_ns + piece.size());
  Put(payload, t_ns);
  payload.append(piece);
  return LogBlock(payload, kPieceBit | 1U);
}

std::string LogEnd(std::uint64_t pushed) {
  LogRecord end;
  end.kind = LogKind::kEnd;
  end.pushed = pushed;
  std::string payload;
  Append(end, payload);
  return LogBlock(payload, 1);
}

std::string LogHead(std::span<const LogSource> sources, std::uint32_t version) {
  nlohmann::ordered_json json;
  if (version >= kVersionInHead) json["version"] = version;
  json["sources"] = nlohmann::ordered_json::array();
  for (const LogSource& source : sources) {
    nlohmann::ordered_json roles;
    for (const auto& role : source.roles)
      roles.push_back(role ? nlohmann::ordered_json(ToString(*role)) : nlohmann::ordered_json());
    json["sources"].push_back({{"family", source.family},
                               {"model", source.model},
                               {"serial", source.serial},
                               {"roles", roles}});
  }
  std::string head(kLogMagic);
  Put(head, version);
  // A serial number may contain invalid UTF-8.
  const std::string text =
      json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  return head + LogBlock(text, static_cast<std::uint32_t>(sources.size()));
}

}  // namespace arthro::simulation
