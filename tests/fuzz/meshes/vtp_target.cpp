// Fuzz target: surfaces, VTP. Corners name points that are there.
#include "tests/fuzz/fuzz_input.h"
#include "tests/fuzz/meshes/read_surface.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::ReadSurfaceOf("surface.vtp", test::TextOf(data, size));
}
