// Log of one attempt: its frames and events in the blocks of a device log
// (device/log/log_format.h). What a block holds is on the disk's way at once; a program that is
// killed loses less than `write_every`. Times in s after the begin of the attempt.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/device/log/log_file.h"
#include "simulation/device/log/log_format.h"
#include "simulation/training/observe/frame_code.h"
#include "simulation/training/steps/attempt_event.h"
#include "simulation/training/track/track_piece.h"

namespace arthro::simulation {

struct AttemptLogOptions {
  double write_every = 0.25;  // s of the attempt
};

class AttemptLog {
 public:
  // `head`: text that tells the attempt, such as exercise and scene. Throws Error(kFile) where the
  // file has content or cannot be written.
  AttemptLog(const std::filesystem::path& file, std::span<const LogSource> hands,
             std::string_view head, const AttemptLogOptions& options = {});

  // Frames and events in the order of their times. They throw nothing for a full disk: Close does.
  void Add(const AttemptFrame& frame);
  void Add(const AttemptEvent& event);
  // A piece larger than kLargestPiece is left out.
  void Add(const TrackPiece& piece);
  bool has_failed() const noexcept { return file_.has_failed(); }
  // Writes the rest and the end. Throws Error(kFile) where a write failed; what was written before
  // can be read.
  void Close();

 private:
  void Append(LogKind kind, double t, std::string_view body);
  void WriteBlock();

  LogFile file_;
  AttemptLogOptions options_;
  FrameEncoder encoder_;
  std::string payload_, body_;
  std::uint32_t count_ = 0;
  std::uint64_t number_ = 0;
  long frames_ = 0;
  double written_ = 0;  // s
  bool is_closed_ = false;
};

// An attempt as it was recorded.
struct RecordedAttempt {
  std::string head;
  std::vector<LogSource> hands;
  std::vector<AttemptFrame> frames;
  std::vector<AttemptEvent> events;
  std::vector<TrackPiece> track;  // tissue (track/tissue_track.h); empty: it was not recorded
  std::string torn;               // a sentence where the log was cut short; empty: it is complete
  std::string track_fault;        // a sentence where pieces of tissue are damaged; empty: none is
};

// Returns true for a log that holds an attempt, and not the samples of hands.
bool IsAttempt(const DeviceLogContent& log) noexcept;

// Throws Error(kBadData) for a log without an attempt, or with a frame or event that cannot be.
RecordedAttempt AttemptOf(const DeviceLogContent& log, const std::filesystem::path& file = {});
RecordedAttempt ReadAttempt(const std::filesystem::path& file);

}  // namespace arthro::simulation
