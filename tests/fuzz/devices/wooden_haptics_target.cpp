// Fuzz target: reports of WoodenHaptics and Polhem. The first byte chooses the model and
// whether its board pads the reports.
#include "tests/fuzz/devices/play_reports.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  if (size == 0) return 0;
  const auto models = simulation::WoodenModels();
  const auto driver =
      simulation::MakeWoodenDriver(models[(data[0] >> 1) % models.size()], (data[0] & 1) != 0);
  test::PlayReports(*driver, test::TextOf(data + 1, size - 1));
  return 0;
}
