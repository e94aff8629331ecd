// A session again from what its devices said.
#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/device/log/log_format.h"
#include "simulation/device/log/log_replay.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

using namespace simulation;

TEST(ReplayJob, ADeviceLogGivesTheForcesOfItsTraceEachTime) {
  TempFolder folder;
  const std::string demo = std::string(ARTHRO_SOURCE_DIR) + "/resources/demo";
  // The instrument of the demo's own trace as a device would have said it, from some time on.
  const auto demo_trace = ReadTrace(demo + "/trace.csv");
  const LogSource source{"", "", "1", {DeviceRole::kInstrument, {}}};
  std::string payload;
  LogRecord record;
  std::uint32_t count = 0;
  for (const TraceRow& row : demo_trace) {
    if (row.device != DeviceRole::kInstrument || row.sample.t > demo_trace[0].sample.t + 3)
      continue;
    record.t_ns = static_cast<std::int64_t>(1e9 * (row.sample.t + 1000));
    record.number = count++;
    record.sample = row.sample;
    record.sample.t += 1000;
    Append(record, payload);
  }
  ASSERT_GT(count, 50u);
  const std::string log = LogHead({&source, 1}) + LogBlock(payload, count);
  WriteAtomically(folder / "session.bin", log + LogEnd(count));
  WriteTrace(folder / "trace.csv", TraceOf(ParseDeviceLog(log)));
  const auto forces = [&](const std::string& input, const std::string& output) {
    const ProgramResult run = RunProgram("replay " + demo + " " + (folder / input).string() +
                                         " -o " + (folder / output).string());
    EXPECT_EQ(run.exit_code, 0) << run.err;
    if (input == "torn.bin") {
      EXPECT_NE(run.err.find("was cut short"), std::string::npos) << run.err;
    }
    return ReadWholeFile(folder / output);
  };
  const std::string expected = forces("trace.csv", "a.csv");
  EXPECT_GT(expected.size(), 50u * count);
  EXPECT_TRUE(forces("session.bin", "b.csv") == expected);
  EXPECT_TRUE(forces("session.bin", "c.csv") == expected);
  // The machine went off in the middle of the next block.
  WriteAtomically(folder / "torn.bin", log + LogBlock(payload, count).substr(0, 1000));
  EXPECT_TRUE(forces("torn.bin", "d.csv") == expected);
}

}  // namespace
}  // namespace arthro::test
