// A device log played again: its bytes through the driver, and its ticks as a recording of hands.
#pragma once

#include "simulation/device/log/log_format.h"
#include "simulation/device/trace_io.h"

namespace arthro::simulation {

struct ReportReplay {
  long reports = 0;               // that the driver was given
  long different = 0;             // after which a hand was not, to the bit, what it was then
  double first_different = 0;     // s
  std::vector<LoggedHand> hands;  // after each report
};

// `source`: of the log's, one that has reports. The records of a log from which some were dropped
// say less: then differences are to be expected. Throws Error(kBadData) where there is no driver.
ReportReplay ReplayReports(const DeviceLogContent& log, int source);

// What the servo saw of the hands that have a role, each sample once. Time begins at 0. Throws
// Error(kBadData): no sample at all, or a gap of more than a minute.
std::vector<TraceRow> TraceOf(const DeviceLogContent& log, const std::filesystem::path& file = {});

// TRACE.csv or a device log, told apart by how it begins. `notice`: a sentence where a log is not
// whole.
std::vector<TraceRow> ReadTraceOrLog(const std::filesystem::path& file, std::string& notice);

}  // namespace arthro::simulation
