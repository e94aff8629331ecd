// Fuzz target: TIFF pictures.
#include "tests/fuzz/fuzz_input.h"
#include "tests/fuzz/pictures/read_picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  const std::string_view bytes = test::TextOf(data, size);
  return test::ReadPictureOf(FormatOf(bytes) == PictureFormat::kTiff, bytes);
}
