// Fuzz target: solids. A solid that is read can be written and read again.
#include "simulation/scene/solids/solid_io.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::Refuses([&] {
    const std::string text =
        JsonFromSolid(ParseSolid(std::string(test::TextOf(data, size)), "s.solid"));
    test::Require(JsonFromSolid(ParseSolid(text)) == text,
                  "a solid that was read can be read again");
  });
}
