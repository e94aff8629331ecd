// Fuzz target: the first bytes of a video.
#include "authoring/footage/video_container.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arthro;
  authoring::IsVideoContainer(test::TextOf(data, size).substr(0, authoring::kContainerBytes));
  return 0;
}
