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

TEST_F(DepthJob, AStrokeRaisesTheMapUnderItAndNothingElse) {
  ASSERT_EQ(Run("", "plain.tiff").exit_code, 0);
  const std::string strokes = (folder_ / "strokes.json").string();
  // Its middle is that of pixel (48, 32).
  WriteAtomically(strokes, R"({"schema": "arthroscene.depth-strokes/1", "strokes": [
    {"kind": "raise", "radius": 0.05, "hardness": 1, "falloff": "smooth", "amount": 0.001,
     "strength": 1, "points": [[0.50520833, 0.33854167]]}]})");
  const auto result = Run("--strokes " + strokes);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const DepthMap plain = ReadDepthMap(folder_ / "plain.tiff"),
                 mended = ReadDepthMap(folder_ / "d.tiff");
  // A float of 10 mm has steps of 1 nm.
  EXPECT_NEAR(mended.at(48, 32), plain.at(48, 32) + 1e-3f, 1e-8);
  for (int y = 0; y < plain.height; ++y)
    for (int x = 0; x < plain.width; ++x)
      ASSERT_TRUE(std::hypot(x - 48, y - 32) <= 0.05 * plain.width + 1 ||
                  mended.at(x, y) == plain.at(x, y) || std::isnan(plain.at(x, y)))
          << x << " " << y;
}

TEST_F(DepthJob, AnImportedMapTakesThePlaceOfTheEstimate) {
  DepthMap own(96, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x) own.at(x, y) = 0.001f + 1e-5f * static_cast<float>(x);
  own.at(3, 4) = 0.0f;
  WriteDepthMap(folder_ / "own.tiff", own);
  const std::string import = "--import " + (folder_ / "own.tiff").string();
  const auto result = Run(import + " --import-meaning relief --import-unit 1");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("0 strokes"), std::string::npos) << result.out;
  const DepthMap depth = ReadDepthMap(folder_ / "d.tiff");
  EXPECT_TRUE(std::isnan(depth.at(3, 4))) << "0 means that no depth is known";
  // The relief passes through a range from the portal, of 50 mm, whose float has steps of 4 nm.
  EXPECT_NEAR(depth.at(50, 20), own.at(50, 20), 1e-8);
  EXPECT_EQ(Run(import + " --noise " + (folder_ / "n.tiff").string(), "e.tiff").exit_code, 2);
  const auto colours = Run("--import " + (folder_ / "p.png").string(), "e.tiff");
  EXPECT_EQ(colours.exit_code, 1);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "e.tiff"));
  EXPECT_NE(colours.err.find("p.png"), std::string::npos) << colours.err;
}

TEST_F(DepthJob, StrokesMendAnImportedMap) {
  DepthMap own(96, 64, 0.002f);
  own.at(48, 32) = 0.012f;  // a peak, such as a glint gives
  WriteDepthMap(folder_ / "own.tiff", own);
  const std::string strokes = (folder_ / "strokes.json").string();
  WriteAtomically(strokes, R"({"schema": "arthroscene.depth-strokes/1", "strokes": [
    {"kind": "mask", "radius": 0.05, "points": [[0.50520833, 0.33854167]]},
    {"kind": "unknown", "radius": 0.05, "hardness": 1, "points": [[0.1, 0.1]]}]})");
  const auto result = Run("--import " + (folder_ / "own.tiff").string() +
                          " --import-meaning relief --import-unit 1 --strokes " + strokes);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("2 strokes"), std::string::npos) << result.out;
  const DepthMap depth = ReadDepthMap(folder_ / "d.tiff");
  // The membrane over a rim of one height is not quite level: ranges are smooth, not heights.
  EXPECT_NEAR(depth.at(48, 32), 0.002, 1e-5);
  EXPECT_TRUE(std::isnan(depth.at(9, 9)));
  EXPECT_NEAR(depth.at(80, 50), 0.002, 1e-8);
}

TEST_F(DepthJob, ASmoothingStrokeLowersTheNoiseThatIsStated) {
  ASSERT_EQ(Run("--noise " + (folder_ / "plain-noise.tiff").string(), "plain.tiff").exit_code, 0);
  const std::string strokes = (folder_ / "strokes.json").string();
  WriteAtomically(strokes, R"({"schema": "arthroscene.depth-strokes/1", "strokes": [
    {"kind": "smooth", "radius": 0.05, "hardness": 1, "strength": 0.5,
     "points": [[0.50520833, 0.33854167]]}]})");
  const auto result = Run("--noise " + (folder_ / "noise.tiff").string() + " --strokes " + strokes);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const DepthMap plain = ReadDepthSigma(folder_ / "plain-noise.tiff"),
                 mended = ReadDepthSigma(folder_ / "noise.tiff");
  EXPECT_NEAR(mended.at(48, 32), 0.5f * plain.at(48, 32), 1e-9);
  ASSERT_TRUE(std::isfinite(plain.at(60, 32)));
  EXPECT_EQ(mended.at(60, 32), plain.at(60, 32)) << "beside the stroke";
}

TEST_F(DepthJob, AStrokeWithoutPointsIsRefused) {
  const std::string strokes = (folder_ / "strokes.json").string();
  WriteAtomically(strokes, R"({"schema": "arthroscene.depth-strokes/1", "strokes": [
    {"kind": "raise", "radius": 0.05, "points": []}]})");
  const auto result = Run("--strokes " + strokes);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("strokes.json"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "d.tiff"));
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
                           "--strokes",
                           "--import",
                           "inverse-square"})
    EXPECT_NE(result.out.find(flag), std::string::npos) << flag << "\n" << result.out;
}

}  // namespace
}  // namespace arthro
