// Fuzz target: logs of attempts: head, frames and events.
#include "simulation/training/attempt_head.h"
#include "simulation/training/attempt_log.h"
#include "tests/fuzz/devices/sealed_log.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  const std::string bytes = test::SealedLog(test::TextOf(data, size));
  return test::Refuses([&] {
    const auto attempt =
        simulation::AttemptOf(simulation::ParseDeviceLog(bytes, "attempt.log"), "attempt.log");
    simulation::AttemptHeadOf(attempt.head, "attempt.log");
  });
}
