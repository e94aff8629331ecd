#include <cmath>

#include <gtest/gtest.h>

#include "authoring/depth/depth_filter.h"
#include "simulation/core/atomic_file.h"
#include "simulation/scene/image_io.h"
#include "tests/support/knee_picture.h"
#include "tests/support/run_program.h"

namespace arthro {
namespace {

class DepthJob : public ::testing::Test {
 protected:
  void SetUp() override { WriteColourImage(folder_ / "p.png", test::KneePicture(96, 64)); }

  test::ProgramResult Run(const std::string& flags, const std::string& output = "d.tiff") {
    return test::RunProgram("depth " + (folder_ / "p.png").string() + " -o " +
                            (folder_ / output).string() + " " + flags);
  }
  float Most(const std::string& output = "d.tiff") {
    float most = -1;
    for (const float h : ReadDepthMap(folder_ / output).relief)
      if (!std::isnan(h)) most = std::max(most, h);
    return most;
  }

  test::TempFolder folder_;
};

TEST_F(DepthJob, WritesWhatTheFilterGives) {
  const auto result = Run("");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("96 x 64 px"), std::string::npos) << result.out;
  EXPECT_EQ(result.err, "");
  const DepthMap depth = ReadDepthMap(folder_ / "d.tiff"),
                 expected = authoring::DepthFromColour(test::KneePicture(96, 64), {});
  ASSERT_EQ(depth.width, 96);
  for (std::size_t i = 0; i < depth.relief.size(); ++i)
    ASSERT_TRUE(depth.relief[i] == expected.relief[i] ||
                (std::isnan(depth.relief[i]) && std::isnan(expected.relief[i])));
}

TEST_F(DepthJob, FlagsAreInMillimetresAndWinOverTheOptionsFile) {
  EXPECT_EQ(Run("--near-relief-mm 12.5").exit_code, 0);
  EXPECT_EQ(Most(), 0.0125f);
  const std::string file = (folder_ / "o.json").string();
  WriteAtomically(file, R"({"near_relief": 0.008, "far_relief": 0.001, "law": "inverse-square"})");
  EXPECT_EQ(Run("--options " + file).exit_code, 0);
  EXPECT_EQ(Most(), 0.008f);
  EXPECT_EQ(Run("--near-relief-mm 15 --options " + file).exit_code, 0);
  EXPECT_EQ(Most(), 0.015f);
  EXPECT_EQ(Run("--options " + file + " --near-relief-mm 15").exit_code, 0);
  EXPECT_EQ(Most(), 0.015f);
}

TEST_F(DepthJob, SameInputGivesTheSameBytesAlsoOnStandardOutput) {
  EXPECT_EQ(Run("", "a.tiff").exit_code, 0);
  EXPECT_EQ(Run("", "b.tiff").exit_code, 0);
  EXPECT_EQ(ReadWholeFile(folder_ / "a.tiff"), ReadWholeFile(folder_ / "b.tiff"));
  const auto piped = test::RunProgram("depth " + (folder_ / "p.png").string() + " -o -");
  EXPECT_EQ(piped.out, ReadWholeFile(folder_ / "a.tiff"));
}

TEST_F(DepthJob, RefusesInOneSentenceAndLeavesTheOldFile) {
  WriteAtomically(folder_ / "d.tiff", "old");
  WriteAtomically(folder_ / "bad.json", "{\"gama\": 2}");
  WriteAtomically(folder_ / "broken.json", "{");
  const auto refused = [&](const std::string& flags, int code, const std::string& says) {
    const auto result = Run("--overwrite " + flags);
    EXPECT_EQ(result.exit_code, code) << flags << result.err;
    EXPECT_NE(result.err.find(says), std::string::npos) << flags << "\n" << result.err;
    EXPECT_EQ(ReadWholeFile(folder_ / "d.tiff"), "old") << flags;
  };
  refused("--options " + (folder_ / "bad.json").string(), 1, "\"gama\" is not known");
  refused("--options " + (folder_ / "broken.json").string(), 1, "not JSON");
  refused("--options " + (folder_ / "none.json").string(), 1, "could not be opened");
  refused("--low-percentile 60 --high-percentile 40", 1, "must lie below");
  refused("--red-weight 0 --green-weight 0 --blue-weight 0", 1, "weights");
  refused("--near-relief-mm 1 --far-relief-mm 2", 1, "far relief, 2 mm");
  refused("--median-radius 99", 2, "median-radius");
  refused("--law cubic", 2, "law");
  refused("--surround-threshold 255 --fill-highlights=false", 1, "nothing but dark surround");
  EXPECT_EQ(test::RunProgram("depth " + (folder_ / "none.png").string() + " -o " +
                             (folder_ / "x.tiff").string())
                .exit_code,
            1);
  EXPECT_EQ(test::RunProgram("depth").exit_code, 2);
  EXPECT_EQ(Run("", "d.png").exit_code, 1);
  EXPECT_EQ(Run("", "no/such/d.tiff").exit_code, 1);
}

TEST_F(DepthJob, SaysThatAPictureIsFlat) {
  ColourImage flat(20, 20);
  std::fill(flat.rgb.begin(), flat.rgb.end(), std::uint8_t{100});
  WriteColourImage(folder_ / "p.png", flat);
  const auto result = Run("");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("one grey throughout"), std::string::npos) << result.err;
}

TEST_F(DepthJob, HelpListsEveryOption) {
  const auto result = test::RunProgram("depth --help");
  EXPECT_EQ(result.exit_code, 0);
  for (const char* flag : {"--red-weight",
                           "--law",
                           "--gamma",
                           "--near-relief-mm",
                           "--far-relief-mm",
                           "--low-percentile",
                           "--high-percentile",
                           "--median-radius",
                           "--texture-size",
                           "--noise",
                           "--surround-threshold",
                           "--border-margin",
                           "--fill-highlights",
                           "--estimator",
                           "--vignette",
                           "--field-of-view-deg",
                           "--correct-tissue",
                           "--iterations",
                           "--options",
                           "inverse-square"})
    EXPECT_NE(result.out.find(flag), std::string::npos) << flag << "\n" << result.out;
}

}  // namespace
}  // namespace arthro
