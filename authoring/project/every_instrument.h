// Instruments of a new scene: one of each kind. An author leaves out those that are not offered.
#pragma once

#include <vector>

#include "simulation/scene/scene.h"

namespace arthro::authoring {

inline std::vector<Instrument> EveryInstrument() {
  return {{"probe", "probe"},
          {"basket forceps", "punch"},
          {"shaver", "shaver"},
          {"grasper", "grasper"}};
}

}  // namespace arthro::authoring
