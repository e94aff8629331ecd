// Small inputs that most jobs read, in one folder: the scene S, presses po.csv, the case case.json
// with its mesh m.vtu.
#pragma once

#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {

class JobInputs : public ::testing::Test {
 protected:
  void SetUp() override {
    WriteSmallScene(At("S"));
    WriteAtomically(At("po.csv"),
                    "hip_x,hip_y,hip_z,tip_x,tip_y,tip_z\n"
                    "0.041,0.02,-0.016,-0.011,0.02,0.177\n-0.021,0.02,-0.016,0.031,0.02,0.177\n");
    WriteAtomically(At("case.json"), R"({"mesh": "m.vtu", "order": 1,
        "material": {"model": "corotated", "young_modulus": 1e6, "poisson_ratio": 0.3,
                     "density": 1100}, "fixed": [{"set": "all", "axes": "xyz"}]})");
    TetMesh tetrahedron;
    tetrahedron.rest_positions = {{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}};
    tetrahedron.elements = {0, 1, 2, 3};
    tetrahedron.sets["all"] = {1, 1, 1, 1};
    WriteTetMesh(At("m.vtu"), tetrahedron);
  }

  std::string At(const std::string& name) const { return (folder_ / name).string(); }
  // `@` before a name stands for the folder.
  std::string Whole(const std::string& arguments) const {
    return std::regex_replace(arguments, std::regex("@"), folder_.path().string() + "/");
  }

  TempFolder folder_;
};

}  // namespace arthro::test
