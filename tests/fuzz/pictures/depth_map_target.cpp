// Fuzz target: depth maps and their standard errors. Every depth is finite or unknown.
#include <cmath>

#include "simulation/scene/image_io.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  const auto file = test::InputFile("depth.tiff", test::TextOf(data, size));
  test::Refuses([&] { ReadDepthSigma(file); });
  return test::Refuses([&] {
    const DepthMap depth = ReadDepthMap(file);
    for (const float relief : depth.relief)
      test::Require(!std::isinf(relief), "a depth is finite or unknown");
  });
}
