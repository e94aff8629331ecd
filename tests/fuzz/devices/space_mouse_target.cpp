// Fuzz target: reports of the SpaceMouse family.
#include "tests/fuzz/devices/play_reports.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  test::PlayReports(*simulation::MakeSpaceMouseDriver(), test::TextOf(data, size));
  return 0;
}
