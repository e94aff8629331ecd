#include "app/view/drawing/passes/shader_text.h"

#include <gtest/gtest.h>

#include "simulation/core/error.h"

namespace arthro::app {
namespace {

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (auto at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(ShaderText, ResolvesEachIncludeOnce) {
  const std::string text = ShaderText("relief_corners.glsl");
  EXPECT_EQ(Count(text, "#include"), 0);
  EXPECT_EQ(Count(text, "float storedDepth(float distance)"), 1);
  EXPECT_EQ(Count(text, "CONSTANT(kNearest"), 1);
}

TEST(ShaderText, BeginsWithItsDefines) {
  const std::string text = ShaderText("backdrop.glsl", {"RELIEF", "VARYING out"});
  EXPECT_LT(text.find("#define RELIEF\n#define VARYING out\n"), text.find("uniform"));
}

TEST(ShaderText, HoldsNoCommentsAndOnlyAscii) {
  for (const char* file : {"backdrop.glsl", "disturb.glsl", "bubble.glsl", "model_common.glsl"}) {
    const std::string text = ShaderText(file);
    EXPECT_EQ(Count(text, "//"), 0) << file;
    for (const char c : text) ASSERT_GT(c, 0) << file;
  }
}

TEST(ShaderText, RefusesAnUnknownFile) { EXPECT_THROW(ShaderText("no_such.glsl"), Error); }

}  // namespace
}  // namespace arthro::app
