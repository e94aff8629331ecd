// Which frames of a clip are worth placing. All of them, as long as there are not too many: an
// overlap more costs little and holds the mosaic together. Beyond that, the sharpest of each
// stretch over which the view moved equally far.
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
    v("every", every, Range{1, 1000}, "", "Take every so-manieth frame of the clip; 1 takes all.");
    v("most_frames", most_frames, Range{2, 5000}, "",
      "Of a longer clip, the sharpest frame of each stretch is taken.");
    v("skip_blank", skip_blank, Any{}, "",
      "Leave out frames that show nothing: black, white or red throughout.");
  }
};

// For each frame "" when it is to be used, else why not. `looks` has one entry a frame; those that
// `every` passes over are not looked at.
std::vector<std::string> ReasonsAgainst(const std::vector<FrameLook>& looks,
                                        const ChooseOptions& options);

}  // namespace arthro::authoring
