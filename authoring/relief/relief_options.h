// Every choice between footage and measured relief, in one list.
#pragma once

#include "authoring/footage/choose_frames.h"
#include "authoring/panorama/preparation/prepare_options.h"
#include "simulation/core/options.h"
#include "simulation/core/part_visitor.h"

namespace arthro::authoring {

struct ReliefOptions {
  ChooseOptions choose{.every = 1, .most_frames = 60, .skip_blank = true};
  PrepareOptions prepare;
  double view_angle = 0.5235987755982988;  // rad
  double insertion = 0.018;                // m
  int points = 700;
  bool use_pivot = true;
  bool find_head_turn = true;
  double cell = 0.008726646259971648;  // rad
  int layers = 64;
  double least_parallax = 0.02617993877991494;  // rad
  double least_confidence = 0.5;
  bool close = true;
  bool use_brightness = true;
  int threads = 2;

  template <class V>
  void Visit(V&& v) {
    choose.Visit(v);
    v("view_angle", view_angle, Range{0, 2.0}, "rad",
      "Oblique view angle of the scope, between its shaft and its optical axis.");
    v("insertion", insertion, Range{0.001, 0.2}, "m",
      "Assumed median distance from the portal to the tip; sets the scale where no length is "
      "given.");
    v("points", points, Range{100, 5000}, "", "Points that are tracked per frame, at most.");
    v("use_pivot", use_pivot, Any{}, "",
      "Use the portal as a soft constraint on the camera positions.");
    v("find_head_turn", find_head_turn, Any{}, "",
      "Find how the camera head is turned on the shaft; without it the head is taken as straight.");
    v("cell", cell, Range{0.002, 0.1}, "rad", "Spacing of the directions that are measured.");
    v("layers", layers, Range{16, 256}, "", "Radii that are tried per direction.");
    v("least_parallax", least_parallax, Range{0.0, 0.5}, "rad",
      "A direction whose rays span less is not measured.");
    v("least_confidence", least_confidence, Range{0.0, 1.0}, "",
      "Cells below this confidence do not count as measured.");
    v("close", close, Any{}, "",
      "Give the cells that were not measured a value, by brightness or between their neighbours.");
    v("use_brightness", use_brightness, Any{}, "",
      "Use brightness as a weak measurement where motion measured nothing.");
    v("threads", threads, Range{1, 64}, "",
      "Threads of the parallel stages; the result does not depend on it.");
    prepare.Visit(PartVisitor<V>{v, "prepare_"});
  }
};

}  // namespace arthro::authoring
