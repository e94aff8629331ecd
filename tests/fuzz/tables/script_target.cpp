// Fuzz target: scripts of the window.
#include "app/platform/script/script.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::Refuses([&] { app::ParseScript(test::TextOf(data, size), "script.txt"); });
}
