// Fuzz target: options of a stage, as jobs and scenes hold them. Options that are read can be
// written and read again.
#include <string>

#include "authoring/depth/depth_options.h"
#include "simulation/core/option_fields.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::Refuses([&] {
    authoring::DepthOptions options;
    ReadOptionsText(test::TextOf(data, size), "options.json", options);
    const std::string text = OptionsText(options);
    ReadOptionsText(text, {}, options);
    test::Require(OptionsText(options) == text, "options that were read can be read again");
  });
}
