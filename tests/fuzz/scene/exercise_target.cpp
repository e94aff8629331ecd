// Fuzz target: an exercise as the records keep it. The text of one is the same each time.
#include "simulation/scene/json/exercise_json.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::Refuses([&] {
    const std::string text = CanonicalJson(ExerciseFromJson(test::TextOf(data, size)));
    test::Require(CanonicalJson(ExerciseFromJson(text)) == text,
                  "an exercise that was read can be read again");
  });
}
