// Fuzz target: traces of hands. A trace that is read can be written and read again.
#include "simulation/device/trace_io.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  return test::Refuses([&] {
    const auto rows = simulation::ParseTrace(test::TextOf(data, size), "trace.csv");
    const std::string text = simulation::TraceText(rows);
    test::Require(simulation::TraceText(simulation::ParseTrace(text)) == text,
                  "a trace that was read can be read again");
  });
}
