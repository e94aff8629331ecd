#include "app/view/drawing/passes/steady_inputs.h"

#include <gtest/gtest.h>

namespace arthro::app {
namespace {

TEST(SteadyInputs, BecomeVertexUniformsAndFlatFragmentInputs) {
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

TEST(SteadyInputs, KeepTheDirectivesOfAVariant) {
  const SteadyInputs inputs = TakeSteadyInputs("#ifdef LENS\nsteady float lensEnd;\n#endif\n");
  EXPECT_EQ(inputs.fragment, "#ifdef LENS\nflat in float lensEnd;\n#endif\n");
  EXPECT_EQ(inputs.uniforms, "#ifdef LENS\nuniform float given_lensEnd;\n#endif\n");
  EXPECT_EQ(inputs.outputs,
            "#ifdef LENS\nflat out float lensEnd;\n#endif\n"
            "void handOn() {\n#ifdef LENS\n  lensEnd = given_lensEnd;\n#endif\n}\n");
}

TEST(SteadyInputs, LeaveAShaderWithoutThemUnchanged) {
  const SteadyInputs inputs = TakeSteadyInputs("// steady hands\nvoid main() {}\n");
  EXPECT_EQ(inputs.fragment, "// steady hands\nvoid main() {}\n");
  EXPECT_EQ(inputs.uniforms, "");
  EXPECT_EQ(inputs.outputs, "void handOn() {\n}\n");
}

}  // namespace
}  // namespace arthro::app
