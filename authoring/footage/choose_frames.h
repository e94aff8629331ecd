// Chooses the frames of a clip that are registered. A short clip keeps all its frames, since
// additional overlap costs little and stabilises the mosaic. A longer clip keeps the sharpest frame
// of each stretch over which the view moved equally far.
#pragma once

#include <string>
#include <vector>

#include "simulation/core/options.h"

namespace arthro::authoring {

struct FrameLook;

struct ChooseOptions {
  int every = 1;
  int most_frames = 400;
  bool skip_blank = true;

  template <class V>
  void Visit(V&& v) {
    v("every", every, Range{1, 1000}, "", "Take every N-th frame of the clip; 1 takes all.");
    v("most_frames", most_frames, Range{2, 5000}, "",
      "Most frames that are used; a longer clip gives the sharpest frame of each stretch.");
    v("skip_blank", skip_blank, Any{}, "",
      "Leave out frames that show nothing: black, white or red throughout.");
  }
};

// Returns one reason per frame: "" for a frame that is used, otherwise why it is not. `looks` has
// one entry per frame; entries that `every` skips are not read.
std::vector<std::string> ReasonsAgainst(const std::vector<FrameLook>& looks,
                                        const ChooseOptions& options);

}  // namespace arthro::authoring
