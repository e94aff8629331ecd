// Fuzz target: lens.json. A lens that is read can be written and read again.
#include "simulation/scene/json/lens_io.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::Refuses([&] {
    const Lens lens = LensFromJson(std::string(test::TextOf(data, size)), "lens.json");
    test::Require(LensFromJson(JsonFromLens(lens), {}).model == lens.model,
                  "a lens that was read can be read again");
  });
}
