// The lens that a clip is taken out of: the one that was given, held against the footage, or where
// none was given a pinhole, which leaves the pictures as they are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "authoring/footage/footage.h"
#include "simulation/core/progress.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

struct FootageLens {
  Lens lens;                // its circle is what every frame shows
  bool is_guessed = false;  // no lens was given: a pinhole whose focal length is a guess
  double wanders = 0;       // px, how far the round window moves over the clip
  cv::Rect part;            // of the raw picture that `lens` describes; all of it if it was given
  std::vector<std::string> warnings;
};

// Looks at a few frames and rewinds. Throws Error(kBadArgument) when the given lens is for pictures
// of another size.
FootageLens LensOf(Footage& footage, const std::optional<Lens>& given, const Progress& progress);

}  // namespace arthro::authoring
