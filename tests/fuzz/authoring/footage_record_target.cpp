// Fuzz target: records of footage. A record that is read can be written and read again, and loses
// its names when it is handed on.
#include "authoring/project/footage_record.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::Refuses([&] {
    const auto record =
        authoring::FootageFromJson(std::string(test::TextOf(data, size)), "footage.json");
    const auto again = authoring::FootageFromJson(authoring::JsonFromFootage(record));
    test::Require(again == record, "a record that was read can be read again");
    for (const authoring::ClipFile& clip : authoring::WithoutNames(record).clips)
      test::Require(clip.file.empty() && clip.beside.empty(),
                    "a record that is handed on has no places of clips");
  });
}
