// Fuzz target: strokes of the depth brushes. Strokes that are read can be written and read again.
#include "authoring/depth/strokes/depth_strokes_io.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::Refuses([&] {
    const std::string text = authoring::StrokesText(
        authoring::StrokesFromText(test::TextOf(data, size), "strokes.json"));
    test::Require(authoring::StrokesText(authoring::StrokesFromText(text, {})) == text,
                  "strokes that were read can be read again");
  });
}
