// Fuzz target: scene archives. The files are unpacked into a temporary folder and read.
#include "simulation/scene/files/scene_io.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  const auto file = test::InputFile("scene.arthro", test::TextOf(data, size));
  return test::Refuses([&] { LoadScene(file); });
}
