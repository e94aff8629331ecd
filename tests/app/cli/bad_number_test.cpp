// Numbers that are none, through the program itself: refused at once, before anything is read.
#include <algorithm>
#include <array>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/run_program.h"

namespace arthro {
namespace {

struct Case {
  const char* job;   // with all that is required
  const char* flag;  // and a value follows
};

constexpr std::array kCases = {
    Case{"pivot none.csv -o none.json", "--rod-length-mm"},
    Case{"pivot none.csv -o none.json --swing scope", "--rod-length-mm"},
    Case{"replay none none.csv -o none.csv", "--rate"},
    Case{"replay none none.csv -o none.csv", "--fps"},
    Case{"replay none none.csv -o none.csv --video none.mp4", "--fps"},
    Case{"replay none none.csv -o none.csv", "--video-size"},
    Case{"view none -o none.png", "--roll-deg"},
    Case{"view none -o none.png", "--head-roll-deg"},
    Case{"view none -o none.png", "--disturb-time"},
    Case{"view none -o none.png", "--disturb-seed"},
    Case{"devices --watch", "--seconds"},
    Case{"edit", "--frames"},
    Case{"practise none", "--frames"},
    Case{"practise none", "--size"},
    Case{"practise none", "--trainee-screen"},
    Case{"bench haptics", "--rounds"},
    Case{"centres none -o none.csv", "--insertion-mm"},
    Case{"tetrahedralize none.stl --unit mm -o none.vtu", "--time-limit"},
};

TEST(BadNumber, IsWrongUseAtOnceAndIsNamedWithItsFlag) {
  for (const Case& test : kCases)
    for (const std::string value : {"nan", "99999999999999999999"}) {
      const auto result = test::RunProgram(std::string(test.job) + " " + test.flag + " " + value,
                                           "DISPLAY= WAYLAND_DISPLAY=");
      EXPECT_EQ(result.exit_code, 2) << test.job << " " << test.flag << " " << value;
      EXPECT_TRUE(result.err.starts_with("arthroscene: ")) << result.err;
      EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
      EXPECT_NE(result.err.find(test.flag), std::string::npos) << result.err;
      EXPECT_NE(result.err.find(value), std::string::npos) << result.err;
      EXPECT_EQ(result.out, "") << "nothing was begun";
    }
}

TEST(BadNumber, OfFramesThatNeverEndIsWrongUse) {
  for (const char* frames : {"0", "-1"})
    EXPECT_EQ(test::RunProgram(std::string("edit --frames ") + frames, "DISPLAY=").exit_code, 2);
}

}  // namespace
}  // namespace arthro
