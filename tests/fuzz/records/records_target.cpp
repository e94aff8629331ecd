// Fuzz target: records of attempts to import. Records that are read can be written and read again.
#include "app/records/attempts/records_text.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::Refuses([&] {
    const std::string text =
        app::RecordsText(app::RecordsFromText(test::TextOf(data, size), "records.json"));
    test::Require(app::RecordsText(app::RecordsFromText(text)) == text,
                  "records that were read can be read again");
  });
}
