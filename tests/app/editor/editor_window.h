// Window of the editor on a small scene, driven by scripts (app/platform/script/script.h).
#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/run_window.h"
#include "tests/support/small_scene.h"

namespace arthro::test {

class EditorWindow : public testing::Test {
 protected:
  void SetUp() override {
    ARTHRO_REQUIRE_XVFB();
    scene = WriteSmallScene(temp / "knee");
  }
  // A failed script tells its line on stderr.
  void Drive(const std::string& script, const std::string& flags = "") {
    const auto result = RunWindow("edit " + scene.string() + " " + flags, script);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  TempFolder temp;
  std::filesystem::path scene;
};

}  // namespace arthro::test
