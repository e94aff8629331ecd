// Fuzz target: presets of lenses. A preset that is read gives a lens.
#include "authoring/lens/lens_preset.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  const auto file = test::InputFile("preset.json", test::TextOf(data, size));
  return test::Refuses([&] {
    const authoring::LensPreset preset = authoring::ReadLensPreset(file);
    authoring::LensFromPreset(preset, 128, 128, {63.5, 63.5, 60});
  });
}
