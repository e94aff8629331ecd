// Fuzz target: presses of a pivot calibration, and the calibration.
#include "simulation/scope/pivot_io.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  const auto file = test::InputFile("poses.csv", test::TextOf(data, size));
  return test::Refuses([&] { simulation::ReadPresses(file); });
}
