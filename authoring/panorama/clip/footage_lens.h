// Lens for the rectification of a clip: the given one, checked against the footage. Without a given
// lens it is a pinhole, which leaves the pictures unchanged.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/footage/footage.h"
#include "simulation/core/progress.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

struct FootageLens {
  Lens lens;                // its circle is the area that every frame shows
  bool is_guessed = false;  // no lens was given: a pinhole with a guessed focal length
  double wanders = 0;       // px, range of the round window's centre over the clip
  cv::Rect
      part;  // part of the raw picture that `lens` describes; the whole picture for a given lens
  std::vector<std::string> warnings;
};

// Reads a few frames and rewinds. Throws Error(kBadArgument) when the given lens is for pictures of
// another size.
FootageLens LensOf(Footage& footage, const std::optional<Lens>& given, const Progress& progress);

}  // namespace arthro::authoring
