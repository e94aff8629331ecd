// Fuzz target: rig files. A rig that is read can be written and read again.
#include "simulation/scene/json/rig_io.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::Refuses([&] {
    const std::string text = RigText(ParseRig(std::string(test::TextOf(data, size)), "rig.json"));
    test::Require(RigText(ParseRig(text)) == text, "a rig that was read can be read again");
  });
}
