// What is the same for all of a picture, as a fragment shader declares it:
//   steady vec3 tip;
// Set as the uniform `given_tip`, it is handed on by the vertices as a flat input. A processor that
// stands in for a graphics card looks up each component of a uniform anew for every eight pixels
// (22 instructions), and a flat input as one (1): a third of the backdrop's shader was looking up.
#pragma once

#include <string>

namespace arthro::app {

struct SteadyInputs {
  std::string uniforms;  // their declarations, for the vertices' shader
  std::string outputs;   // there too: declarations, and handOn(), which its main calls
  std::string fragment;  // the shader as the compiler takes it
};
// A declaration is a line of its own; it may name several.
SteadyInputs TakeSteadyInputs(const std::string& fragment);

}  // namespace arthro::app
