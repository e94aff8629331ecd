#include "simulation/training/attempt_log.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "simulation/core/byte_stream.h"
#include "simulation/core/error.h"

namespace arthro::simulation {
namespace {

constexpr auto kLastEvent = EventKind::kFault;

// A text longer than this is cut off; no id is as long.
constexpr std::size_t kLongestText = 4096;

void PutText(std::string& bytes, std::string_view text) {
  text = text.substr(0, kLongestText);
  PutBytes(bytes, static_cast<std::uint16_t>(text.size()));
  bytes.append(text);
}

bool TakeText(std::string_view& bytes, std::string& text) {
  std::uint16_t size = 0;
  if (!TakeBytes(bytes, size) || bytes.size() < size) return false;
  text = bytes.substr(0, size);
  bytes.remove_prefix(size);
  return true;
}

bool TakeEvent(std::string_view bytes, AttemptEvent& event) {
  std::uint8_t kind = 0;
  if (!TakeBytes(bytes, event.t) || !TakeBytes(bytes, kind) || !TakeBytes(bytes, event.value) ||
      !TakeText(bytes, event.step) || !TakeText(bytes, event.target) ||
      !TakeText(bytes, event.note))
    return false;
  event.kind = static_cast<EventKind>(kind);
  return bytes.empty() && kind <= static_cast<std::uint8_t>(kLastEvent) &&
         std::isfinite(event.t + event.value);
}

}  // namespace

AttemptLog::AttemptLog(const std::filesystem::path& file, std::span<const LogSource> hands,
                       std::string_view head, const AttemptLogOptions& options)
    : file_(file, LogHead(hands)), options_(options) {
  Append(LogKind::kAttempt, 0, head.substr(0, kLargestBody));
  WriteBlock();
}

void AttemptLog::Append(LogKind kind, double t, std::string_view body) {
  AppendBody(kind, std::llround(1e9 * t), number_++, body, payload_);
  ++count_;
  constexpr std::size_t kFull = kLargestBlock - 2 * kLargestBody;  // bytes
  if (t < written_ + options_.write_every && payload_.size() < kFull) return;
  WriteBlock();
  written_ = t;
}

void AttemptLog::WriteBlock() {
  if (count_ > 0) file_.Write(LogBlock(payload_, count_));
  payload_.clear();
  count_ = 0;
}

void AttemptLog::Add(const AttemptFrame& frame) {
  encoder_.Encode(frame, body_);
  Append(LogKind::kFrame, kFrameTime * static_cast<double>(++frames_), body_);
}

void AttemptLog::Add(const AttemptEvent& event) {
  body_.clear();
  PutBytes(body_, event.t);
  PutBytes(body_, static_cast<std::uint8_t>(event.kind));
  PutBytes(body_, event.value);
  for (const std::string* text : {&event.step, &event.target, &event.note}) PutText(body_, *text);
  Append(LogKind::kEvent, event.t, body_);
}

void AttemptLog::Add(const TrackPiece& piece) {
  if (piece.bytes.size() <= kLargestPiece)
    file_.Write(PieceBlock(std::llround(1e9 * piece.t), piece.bytes));
}

void AttemptLog::Close() {
  if (is_closed_) return;
  is_closed_ = true;
  WriteBlock();
  file_.Write(LogEnd(number_));
  file_.Close();
}

bool IsAttempt(const DeviceLogContent& log) noexcept {
  return std::ranges::any_of(log.attempt,
                             [](const LoggedBody& body) { return body.kind == LogKind::kAttempt; });
}

RecordedAttempt AttemptOf(const DeviceLogContent& log, const std::filesystem::path& file) {
  if (!IsAttempt(log))
    throw Error(Code::kBadData,
                "this log holds no attempt; give one that was recorded of an exercise", file);
  RecordedAttempt attempt;
  attempt.hands = log.sources;
  attempt.torn = log.torn;
  if (log.damaged_pieces > 0)
    attempt.track_fault = fmt::format(
        "{} of {} records of the tissue are damaged, so tissue is not shown everywhere as it was; "
        "take another copy of the file",
        log.damaged_pieces, log.damaged_pieces + static_cast<long>(log.pieces.size()));
  attempt.track.reserve(log.pieces.size());
  for (const LoggedBody& piece : log.pieces)
    attempt.track.push_back(
        {1e-9 * static_cast<double>(piece.t_ns), log.bodies.substr(piece.begin, piece.size)});
  FrameDecoder decoder;
  for (const LoggedBody& body : log.attempt) {
    const std::string_view bytes = std::string_view(log.bodies).substr(body.begin, body.size);
    bool is_good = true;
    if (body.kind == LogKind::kAttempt) attempt.head = bytes;
    if (body.kind == LogKind::kFrame)
      is_good = decoder.Decode(bytes, attempt.frames.emplace_back());
    if (body.kind == LogKind::kEvent) is_good = TakeEvent(bytes, attempt.events.emplace_back());
    if (!is_good)
      throw Error(Code::kBadData,
                  fmt::format("a record of this attempt, at {:.2f} s, cannot be; use the program "
                              "that recorded it",
                              1e-9 * static_cast<double>(body.t_ns)),
                  file);
  }
  return attempt;
}

RecordedAttempt ReadAttempt(const std::filesystem::path& file) {
  return AttemptOf(ReadDeviceLog(file), file);
}

}  // namespace arthro::simulation
