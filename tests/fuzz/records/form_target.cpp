// Fuzz target: rating forms. A form that is read can be written and read again.
#include "app/records/exchange/rating_form.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::Refuses([&] {
    const std::string text =
        app::FormText(app::FormFromText(test::TextOf(data, size), "form.json"));
    test::Require(app::FormText(app::FormFromText(text)) == text,
                  "a form that was read can be read again");
  });
}
