// Fuzz target: tie points of a panorama.
#include "authoring/panorama/ties/tie_file.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::Refuses(
      [&] { authoring::ParseTies(std::string(test::TextOf(data, size)), "ties.json"); });
}
