// Fuzz target: logs of devices, and what is made of them: reports played again through their
// drivers, and the recording of the hands. An input that does not begin as a log is the content of
// a block, whose checksums are added here, since a fuzzer does not find them.
#include "simulation/device/log/log_replay.h"
#include "tests/fuzz/devices/sealed_log.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  const std::string bytes = test::SealedLog(test::TextOf(data, size));
  test::Refuses([&] {
    const simulation::DeviceLogContent log = simulation::ParseDeviceLog(bytes, "session.bin");
    for (std::size_t i = 0; i < log.sources.size(); ++i)
      test::Refuses([&] { simulation::ReplayReports(log, static_cast<int>(i)); });
    simulation::RecordingOf(log, "session.bin");
  });
  return 0;
}
