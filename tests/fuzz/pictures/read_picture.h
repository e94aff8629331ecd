// A picture from the bytes of a fuzz input, and the same one without its metadata, as a copy of a
// scene has it.
#pragma once

#include "simulation/scene/backdrop/clean_picture.h"
#include "simulation/scene/formats/picture_formats.h"
#include "simulation/scene/image_io.h"
#include "tests/fuzz/fuzz_input.h"

namespace arthro::test {

// Bytes of another format are left to the target of that format; kUnknown takes all that have none.
inline int ReadPictureOf(bool is_of_target, std::string_view bytes) {
  if (!is_of_target) return -1;  // not kept in the corpus
  const auto file = InputFile("picture", bytes);
  return Refuses([&] {
    const ColourImage picture = ReadColourImage(file);
    const auto pixels =
        static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
    Require(picture.rgb.size() == 3 * pixels, "a picture has all its pixels");
    const auto clean = PictureWithoutMetadata(bytes);
    if (clean) ReadColourImage(InputFile("clean", *clean));
  });
}

}  // namespace arthro::test
