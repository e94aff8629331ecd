// Fuzz target: notes of placing tissues, which scene.json keeps beside the scene's values.
#include "authoring/alignment/placing_notes.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::Refuses([&] {
    const auto notes = authoring::NotesFromText(std::string(test::TextOf(data, size)));
    test::Require(authoring::NotesFromText(authoring::NotesText(notes)) == notes,
                  "notes that were read can be read again");
  });
}
