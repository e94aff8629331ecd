// Replay of a device log: its bytes through the driver, and its ticks as a recording of hands.
#pragma once

#include "simulation/device/log/log_format.h"
#include "simulation/device/trace_io.h"

namespace arthro::simulation {

struct ReportReplay {
  long reports = 0;               // reports given to the driver
  long different = 0;             // reports after which a hand differed from the log in any bit
  double first_different = 0;     // s
  std::vector<LoggedHand> hands;  // hands after each report
};

// Replays `source` of the log, which must have reports. Differences are to be expected where
// records were dropped. Throws Error(kBadData) where there is no driver.
ReportReplay ReplayReports(const DeviceLogContent& log, int source);

// A wish counts for the ticks after its time.
struct TimedWish {
  double t = 0;  // s
  LoggedWish wish;
};

struct TimedOption {
  double t = 0;  // s
  LoggedOption option;
};

// A practice as it was recorded, on one clock.
struct Recording {
  std::vector<TraceRow> rows;
  std::vector<TimedWish> wishes = {};     // none in TRACE.csv and in logs before version 3
  std::vector<TimedOption> options = {};  // none in TRACE.csv and in logs before version 4
};

// Returns the samples of the hands with a role, each once, the wishes and the options. Time begins
// at 0 with the first sample. Throws Error(kBadData) for no sample.
Recording RecordingOf(const DeviceLogContent& log, const std::filesystem::path& file = {});

// Reads TRACE.csv or a device log, distinguished by their first bytes. `notice` is a sentence where
// a log is incomplete.
Recording ReadRecording(const std::filesystem::path& file, std::string& notice);

}  // namespace arthro::simulation
