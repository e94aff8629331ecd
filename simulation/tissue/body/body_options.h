// All options of living tissue in one list: solver, contact with tools, sleep, cuts.
#pragma once

#include "simulation/core/options.h"
#include "simulation/tissue/contact/tool_contact.h"
#include "simulation/tissue/cut/cutters.h"
#include "simulation/tissue/solver/implicit_solver.h"

namespace arthro::simulation {

struct BodyOptions {
  // One Newton iteration follows a slow hand, and nineteen of twenty steps need no more than two;
  // a tool that comes onto other skin in a step needs up to eight. What is left unbalanced pushes
  // it somewhere else in the next: with at most three, 8 % of a soak's steps ended so, with eight
  // 2 %, and the slowest steps were no slower.
  SolverOptions solver{.max_newton = 8};
  ToolContactOptions contact;
  ShaverOptions shaver;
  double sleep_speed = 2e-4;
  int refresh_iterations = 12;
  double coupling_tolerance = 0.05;
  double cut_spacing = 3.5e-4;
  template <class V>
  void Visit(V&& v) {
    solver.Visit(v);
    contact.Visit(v);
    shaver.Visit(v);
    v("sleep_speed", sleep_speed, Range{0, 1}, "m/s",
      "A tissue that nothing touches and whose nodes are slower than this sleeps.");
    v("refresh_iterations", refresh_iterations, Range{1, 1000}, "",
      "A step that needed more has the preconditioner made anew, beside the next steps.");
    v("coupling_tolerance", coupling_tolerance, Range{1e-8, 0.5}, "",
      "Energy error, of the whole, to which the stiffness that the servo gets is solved; the "
      "stiffness is off by its square.");
    v("cut_spacing", cut_spacing, Range{5e-5, 2e-3}, "m",
      "Grid on which cuts are kept: the resolution of cut faces.");
  }
};

}  // namespace arthro::simulation
