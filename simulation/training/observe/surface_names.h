// Names of the surfaces of a scene in the order of ToolFrame::contact: the backdrop, then each
// tissue.
#pragma once

#include <string>
#include <vector>

#include "simulation/practice/replay/replay.h"

namespace arthro::simulation {

inline std::vector<std::string> SurfaceNames(const Scene& scene) {
  std::vector<std::string> names;
  for (int i = 0; i <= static_cast<int>(scene.tissues.size()); ++i)
    names.push_back(ContactName(i, scene));
  return names;
}

}  // namespace arthro::simulation
