// Fuzz target: depth maps of other programs, and the relief that they give.
#include "authoring/depth/depth_import.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  const auto file = test::InputFile("import", test::TextOf(data, size));
  return test::Refuses([&] {
    const auto numbers = authoring::ReadGreyNumbers(file);
    authoring::ReliefFromNumbers(numbers, {}, 0.05, numbers.width, numbers.height, file);
  });
}
