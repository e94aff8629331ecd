#include "app/view/drawing/steady_inputs.h"

#include <gtest/gtest.h>

namespace arthro::app {
namespace {

TEST(SteadyInputs, AreUniformsOfTheVerticesAndFlatInputsOfTheFragments) {
  const SteadyInputs inputs = TakeSteadyInputs(
      "uniform sampler2D panorama;\n"
      "steady vec3 tip, viewAxis;  // in radii\n"
      "steady float terms[10];\n"
      "void main() {}\n");
  EXPECT_EQ(inputs.fragment,
            "uniform sampler2D panorama;\n"
            "flat in vec3 tip;\nflat in vec3 viewAxis;\nflat in float terms[10];\n"
            "void main() {}\n");
  EXPECT_EQ(inputs.uniforms,
            "uniform vec3 given_tip;\nuniform vec3 given_viewAxis;\n"
            "uniform float given_terms[10];\n");
  EXPECT_EQ(inputs.outputs,
            "flat out vec3 tip;\nflat out vec3 viewAxis;\nflat out float terms[10];\n"
            "void handOn() {\n  tip = given_tip;\n  viewAxis = given_viewAxis;\n"
            "  terms = given_terms;\n}\n");
}

TEST(SteadyInputs, WithoutAnyTheShaderStaysAsItIs) {
  const SteadyInputs inputs = TakeSteadyInputs("// steady hands\nvoid main() {}\n");
  EXPECT_EQ(inputs.fragment, "// steady hands\nvoid main() {}\n");
  EXPECT_EQ(inputs.uniforms, "");
  EXPECT_EQ(inputs.outputs, "void handOn() {\n}\n");
}

}  // namespace
}  // namespace arthro::app
