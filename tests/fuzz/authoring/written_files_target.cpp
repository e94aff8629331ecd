// Fuzz target: the list of written files in a scene's folder, by which a save removes some.
#include "authoring/project/files/written_files.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::Refuses([&] {
    const auto files =
        authoring::WrittenFilesFromJson(std::string(test::TextOf(data, size)), "scene.json");
    for (const auto& [name, mark] : files) {
      const auto place = (std::filesystem::path("/knee") / name).lexically_normal().string();
      test::Require(place.starts_with("/knee/") && place != "/knee/scene.json",
                    "a name of the list stays in the folder, and is not the scene");
    }
    test::Require(
        authoring::WrittenFilesFromJson(authoring::JsonFromWrittenFiles(files), {}) == files,
        "a list that was read can be read again");
  });
}
