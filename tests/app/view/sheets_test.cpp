// Sheets of reviewed pictures: every view angle, relief, instruments and each disturbance. Beside
// each sheet stands one that is wrong in a single tile, which the comparison must reject.
#include <algorithm>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "simulation/core/units.h"
#include "tests/app/view/view_scene.h"
#include "tests/support/build_paths.h"
#include "tests/support/compare_pictures.h"

namespace arthro::test {
namespace {

using namespace app;

constexpr int kTileSize = 200;  // px

// Places square pictures side by side, `columns` in a row.
ColourImage Sheet(const std::vector<ColourImage>& pictures, int columns) {
  const int rows = static_cast<int>(pictures.size()) / columns;
  ColourImage sheet(columns * kTileSize, rows * kTileSize);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const int left = static_cast<int>(i) % columns * kTileSize,
              top = static_cast<int>(i) / columns * kTileSize;
    for (int y = 0; y < kTileSize; ++y)
      std::copy_n(pictures[i].at(0, y), 3 * kTileSize, sheet.at(left, top + y));
  }
  return sheet;
}

class Sheets : public testing::Test {
 protected:
  void Load(const LoadedScene& loaded) {
    try {
      pictures_ = std::make_unique<StillPictures>(loaded);
    } catch (const Error& error) {
      GTEST_SKIP() << "NOT TESTED, NOTHING WAS DRAWN: " << error.what();
    }
  }
  ColourImage Draw(const Picture& picture) { return pictures_->Draw(picture, kTileSize); }
  static void ExpectCaught(const ColourImage& wrong, const std::string& name, const char* what) {
    const PictureDifference difference = DifferenceFromBaseline(wrong, name);
    EXPECT_TRUE(difference.comparable);
    EXPECT_FALSE(difference.passes()) << what << ": " << difference.Sentence();
  }
  std::unique_ptr<StillPictures> pictures_;
};

// In gas, so that highlights of tissue are seen.
LoadedScene DemoScene() {
  LoadedScene loaded = LoadScene(std::string(ARTHRO_SOURCE_DIR) + "/resources/demo");
  loaded.scene.backdrop.medium = Medium::kGas;
  return loaded;
}

// The demo's knee, with the scope rolled by 120 degrees and its head upright: condyle, meniscus,
// rim of the plateau, capsule.
TEST_F(Sheets, EveryViewAngleShowsItsOwnPartOfTheKnee) {
  Load(DemoScene());
  if (IsSkipped()) return;
  const auto sheet = [&](double second_angle) {
    std::vector<ColourImage> tiles;
    for (const double angle : {0.0, second_angle, 70.0, 90.0}) {
      Picture picture = PictureFromPose(
          {RadiansFromDegrees(-8), RadiansFromDegrees(2), RadiansFromDegrees(120), 0.012},
          RadiansFromDegrees(angle), RadiansFromDegrees(90), 0.0);
      picture.relief = kUsualRelief;
      tiles.push_back(Draw(picture));
    }
    return Sheet(tiles, 2);
  };
  EXPECT_TRUE(MatchesBaseline(sheet(30.0), "sheet_view_angles"));
  ExpectCaught(sheet(31.0), "sheet_view_angles", "a degree off");
}

// Parallax: between the two pictures the tip moves 4 mm to the right, and both look at the same
// place of the sphere.
TEST_F(Sheets, ReliefShowsParallax) {
  Load(DemoScene());
  if (IsSkipped()) return;
  const auto sheet = [&](const ReliefSearch& relief) {
    std::vector<ColourImage> tiles;
    for (const double across : {-1.0, 1.0}) {
      // Swung one way, and rolled to look back the other way.
      Picture picture =
          PictureFromPose({-0.05, 0.12 * across - 0.2, -0.5 * std::numbers::pi * across, 0.017},
                          RadiansFromDegrees(10), RadiansFromDegrees(90), 0.0);
      picture.relief = relief;
      tiles.push_back(Draw(picture));
    }
    return Sheet(tiles, 2);
  };
  EXPECT_TRUE(MatchesBaseline(sheet(kUsualRelief), "sheet_relief"));
  ExpectCaught(sheet({}), "sheet_relief", "colours on the bare sphere");
}

// In front of the ring, and through it, so that one side of the ring hides the rod and the other
// does not.
TEST_F(Sheets, AnInstrumentInFrontOfTissueAndBehindIt) {
  LoadedScene loaded = MakeViewScene();
  loaded.scene.tissues[0].pose.position = {0.0, 0.003, 0.024};
  Load(loaded);
  if (IsSkipped()) return;
  const auto sheet = [&](const glm::dvec3& displaced, bool has_second = true) {
    std::vector<ColourImage> tiles;
    for (const bool is_behind : {false, true}) {
      Picture picture =
          PictureFromPose({-0.25, 0.0, 0.0, 0.006}, RadiansFromDegrees(10), RadiansFromDegrees(80));
      picture.relief = kUsualRelief;
      const glm::dvec3 tip = is_behind ? glm::dvec3(-0.014, 0.004, 0.036) + displaced
                                       : glm::dvec3(-0.002, 0.002, 0.018);
      if (!is_behind || has_second) picture.instrument = InstrumentView{{0.03, 0, 0}, tip, 0.4};
      tiles.push_back(Draw(picture));
    }
    return Sheet(tiles, 2);
  };
  EXPECT_TRUE(MatchesBaseline(sheet({}), "sheet_instrument"));
  ExpectCaught(sheet({0.0, -0.001, 0.0}), "sheet_instrument", "a millimetre off");
  ExpectCaught(sheet({}, false), "sheet_instrument", "none behind");
}

TEST_F(Sheets, BackdropAlone) {
  LoadedScene loaded = MakeViewScene();
  loaded.scene.tissues.clear();
  loaded.surfaces.clear();
  Load(loaded);
  if (IsSkipped()) return;
  Picture picture =
      PictureFromPose({-0.4, 0.05, 0.0, 0.010}, RadiansFromDegrees(30), RadiansFromDegrees(90));
  picture.relief = kUsualRelief;
  EXPECT_TRUE(MatchesBaseline(Draw(picture), "view_empty"));
  picture.notch = 0.1;
  ExpectCaught(Draw(picture), "view_empty", "the rim's mark by 6 degrees");
}

// The demo's knee with a probe near the lens.
TEST_F(Sheets, EachDisturbance) {
  Load(DemoScene());
  if (IsSkipped()) return;
  Picture picture = PictureFromPose({RadiansFromDegrees(-12), RadiansFromDegrees(2), 0.0, 0.015},
                                    RadiansFromDegrees(10), RadiansFromDegrees(90));
  picture.relief = kUsualRelief;
  picture.instrument = InstrumentView{
      {0.018, 0, 0}, picture.view.tip + 0.009 * picture.view.view - 0.002 * picture.view.up, 0.4};
  using Strengths = std::vector<std::pair<double Disturbances::*, double>>;
  const auto sheet = [&](const Strengths& strengths, std::size_t left_out = 4) {
    std::vector<ColourImage> tiles;
    for (std::size_t i = 0; i < 4; ++i) {
      picture.disturbances = {};
      if (i < strengths.size() && i != left_out)
        picture.disturbances.*strengths[i].first = strengths[i].second;
      tiles.push_back(Draw(picture));
    }
    return Sheet(tiles, 2);
  };
  const Strengths in_the_way{{&Disturbances::haze, 0.5},
                             {&Disturbances::bubbles, 0.6},
                             {&Disturbances::debris, 0.7},
                             {&Disturbances::fog, 0.5}};
  const Strengths of_the_camera{{&Disturbances::near_blur, 0.7},
                                {&Disturbances::far_blur, 0.7},
                                {&Disturbances::overexposure, 0.6}};
  EXPECT_TRUE(MatchesBaseline(sheet(in_the_way), "sheet_disturbances"));
  EXPECT_TRUE(MatchesBaseline(sheet(of_the_camera), "sheet_camera_faults"));
  for (std::size_t i = 0; i < in_the_way.size(); ++i)
    ExpectCaught(sheet(in_the_way, i), "sheet_disturbances", "one left out");
  for (std::size_t i = 0; i < of_the_camera.size(); ++i)
    ExpectCaught(sheet(of_the_camera, i), "sheet_camera_faults", "one left out");
}

}  // namespace
}  // namespace arthro::test
