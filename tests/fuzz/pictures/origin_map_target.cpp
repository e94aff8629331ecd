// Fuzz target: origins of depths.
#include "simulation/scene/image_io.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  const auto file = test::InputFile("origin.png", test::TextOf(data, size));
  return test::Refuses([&] { ReadOriginMap(file); });
}
