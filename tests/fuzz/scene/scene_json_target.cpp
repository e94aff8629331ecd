// Fuzz target: scene.json. A scene that is read can be written and read again.
#include "simulation/core/json_text.h"
#include "simulation/scene/files/exercise_check.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/json/scene_json.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  const auto file = test::InputFile("scene.json", test::TextOf(data, size));
  return test::Refuses([&] {
    const Scene scene = ReadScene(file);
    static_cast<void>(ExerciseFaults(scene));
    std::vector<JsonFault> faults;
    SceneFromJson(ParseJson(PrettyJson(JsonFromScene(scene)), Code::kBadScene), faults);
    test::Require(faults.empty(), "a scene that was read can be read again");
  });
}
