// Fuzz target: tables of the window's words in another language, and texts found by them.
#include "app/platform/translation.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::Refuses([&] {
    const auto entries = app::ParsePo(test::TextOf(data, size), "de.po");
    app::Translation translation(entries);
    for (const app::PoEntry& entry : entries) {
      translation.Of(entry.english);
      translation.Of(" Tissue " + entry.english + ".");
    }
  });
}
