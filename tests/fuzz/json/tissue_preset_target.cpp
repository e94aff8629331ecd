// Fuzz target: presets of tissues, with their looks.
#include "simulation/tissue/body/tissue_preset.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  const auto file = test::InputFile("preset.json", test::TextOf(data, size));
  return test::Refuses([&] { simulation::ReadTissuePreset(file); });
}
