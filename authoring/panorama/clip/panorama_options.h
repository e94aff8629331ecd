// All options from footage to panorama in one list: the stages' own options, under the stage's name
// when two stages share an option's name.
#pragma once

#include "authoring/footage/choose_frames.h"
#include "authoring/lens/rectify_options.h"
#include "authoring/panorama/compose/compose_options.h"
#include "authoring/panorama/graph/register_options.h"
#include "authoring/panorama/preparation/prepare_options.h"
#include "simulation/core/options.h"
#include "simulation/core/part_visitor.h"

namespace arthro::authoring {

struct PanoramaOptions {
  double working_scale = 0;
  int least_piece = 3;
  bool self_calibrate = false;
  bool mask_text = false;
  ChooseOptions choose;
  RectifyOptions rectify;
  PrepareOptions prepare;
  RegisterOptions registration;
  ComposeOptions compose;

  template <class V>
  void Visit(V&& v) {
    v("working_scale", working_scale, Range{0, 2}, "",
      "Scale of matching, relative to the rectified size; 0 chooses it by the size of the "
      "picture.");
    v("least_piece", least_piece, Range{2, 1000}, "frames",
      "Least number of frames of a separate piece that is composed.");
    v("self_calibrate", self_calibrate, Any{}, "",
      "Repeat with the focal length of the frames when it differs from the lens file's by more "
      "than 1 %.");
    v("mask_text", mask_text, Any{}, "",
      "Draw the panorama without areas that never change while the picture moves, such as text.");
    choose.Visit(v);
    registration.Visit(v);
    rectify.Visit(PartVisitor<V>{v, "rectify_"});
    prepare.Visit(PartVisitor<V>{v, "prepare_"});
    compose.Visit(PartVisitor<V>{v, "compose_"});
  }
};

}  // namespace arthro::authoring
