// Fuzz target: pairs of landmarks for `arthroscene align`.
#include "authoring/alignment/landmark_file.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::Refuses(
      [&] { authoring::ParsePairs(std::string(test::TextOf(data, size)), "pairs.json"); });
}
