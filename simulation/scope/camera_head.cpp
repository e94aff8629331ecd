#include "simulation/scope/camera_head.h"

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::simulation {

CameraHead CameraHeadFromString(std::string_view word) {
  if (word == "scope") return {};
  if (word == "upright") return {.is_upright = true};
  throw Error(Code::kBadArgument,
              fmt::format("the camera head is held \"upright\" or turns with the \"scope\", not "
                          "\"{}\"; give one of the two",
                          word));
}

}  // namespace arthro::simulation
