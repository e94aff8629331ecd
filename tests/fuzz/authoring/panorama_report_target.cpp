// Fuzz target: reports of panoramas. A report that is read can be written and read again.
#include "authoring/panorama/report_io.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  const std::string text(test::TextOf(data, size));
  test::Refuses([&] { authoring::ViewFromReport(text, "report.json"); });
  return test::Refuses([&] {
    const authoring::PanoramaReport report = authoring::ReportFromJson(text, "report.json");
    const std::string again = authoring::JsonFromReport(report);
    test::Require(authoring::ReportFromJson(again).frames.size() == report.frames.size(),
                  "a report that was read can be read again");
  });
}
