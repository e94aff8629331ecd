// Fuzz target: reports of a DualSense or a DualShock 4. The first byte chooses the pad and its
// connection.
#include "tests/fuzz/devices/play_reports.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  if (size == 0) return 0;
  using enum simulation::DeviceFamily;
  const auto driver =
      simulation::MakePadDriver((data[0] & 1) != 0 ? kDualSense : kDualShock4, (data[0] & 2) != 0);
  test::PlayReports(*driver, test::TextOf(data + 1, size - 1));
  return 0;
}
