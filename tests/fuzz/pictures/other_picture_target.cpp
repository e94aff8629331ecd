// Fuzz target: pictures of the other formats that are read: BMP, WebP, PNM.
#include "tests/fuzz/fuzz_input.h"
#include "tests/fuzz/pictures/read_picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  const std::string_view bytes = test::TextOf(data, size);
  const PictureFormat format = FormatOf(bytes);
  return test::ReadPictureOf(format != PictureFormat::kPng && format != PictureFormat::kJpeg &&
                                 format != PictureFormat::kTiff,
                             bytes);
}
