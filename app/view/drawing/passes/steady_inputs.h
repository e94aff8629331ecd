// Inputs that are constant over a picture, as a fragment shader declares them:
//   steady vec3 tip;
// Set as the uniform `given_tip`, the vertices hand it on as a flat input. A software rasteriser
// reads each component of a uniform anew for every eight pixels (22 instructions), and a flat input
// as one (1 instruction): a third of the backdrop's shader was such reads.
#pragma once

#include <string>

namespace arthro::app {

struct SteadyInputs {
  std::string uniforms;  // declarations for the vertex shader
  std::string outputs;   // the same shader's outputs, and handOn(), which its main calls
  std::string fragment;  // fragment shader as the compiler takes it
};
// A declaration is a line of its own; it may name several inputs.
SteadyInputs TakeSteadyInputs(const std::string& fragment);

}  // namespace arthro::app
