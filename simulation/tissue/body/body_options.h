// All options of simulated tissue in one list: solver, contact with tools, sleep, cuts.
#pragma once

#include "simulation/core/options.h"
#include "simulation/tissue/contact/tool_contact.h"
#include "simulation/tissue/cut/cutters.h"
#include "simulation/tissue/solver/implicit_solver.h"

namespace arthro::simulation {

struct BodyOptions {
  // One Newton iteration follows a slow hand; 19 of 20 steps need at most two. A tool that moves
  // onto other skin in a step needs up to eight. A residual left over moves the tissue in the next
  // step. A limit of three left one in 8 % of the steps of a soak test, a limit of eight in 2 %,
  // and the slowest steps took no longer; those are cut short by their work.
  SolverOptions solver{.max_newton = 8, .max_work = 105};
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
      "Speed of nodes below which an untouched tissue sleeps.");
    v("refresh_iterations", refresh_iterations, Range{1, 1000}, "",
      "Iterations above which a new preconditioner is made, in parallel with the next steps.");
    v("coupling_tolerance", coupling_tolerance, Range{1e-8, 0.5}, "",
      "Relative energy error of the stiffness that is solved for the servo; the error of the "
      "stiffness is its square.");
    v("cut_spacing", cut_spacing, Range{5e-5, 2e-3}, "m",
      "Spacing of the grid that stores cuts: the resolution of cut faces.");
  }
};

}  // namespace arthro::simulation
