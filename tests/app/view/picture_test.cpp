// Whole pictures: equal bytes in every run, and equal to reviewed baselines.
#include <glm/geometric.hpp>

#include "simulation/core/units.h"
#include "tests/app/view/view_scene.h"
#include "tests/support/compare_pictures.h"

namespace arthro::test {
namespace {

using app::Disturbances;
using app::Picture;
using app::PictureFromPose;
using app::StillPictures;

Picture ScenePicture() {
  Picture picture =
      PictureFromPose({-0.12, 0.05, 0.2, 0.008}, RadiansFromDegrees(30), RadiansFromDegrees(90));
  picture.instrument = ProbeInFront();
  return picture;
}

std::unique_ptr<StillPictures> Start(const LoadedScene& loaded, std::string* why) {
  try {
    return std::make_unique<StillPictures>(loaded);
  } catch (const Error& error) {
    *why = error.what();
    return nullptr;
  }
}

#define START_OR_SKIP(pictures, loaded)      \
  std::string why;                           \
  const auto pictures = Start(loaded, &why); \
  if (!pictures) GTEST_SKIP() << "NOT TESTED, NOTHING WAS DRAWN: " << why

TEST(StillPicture, TissueAndProbeInAJoint) {
  START_OR_SKIP(pictures, MakeViewScene());
  EXPECT_TRUE(MatchesBaseline(pictures->Draw(ScenePicture(), 320), "view_tissue_and_probe"));
}

TEST(StillPicture, SteepScopeWithItsHeadTurned) {
  START_OR_SKIP(pictures, MakeViewScene());
  const Picture picture = PictureFromPose({-0.05, 0.35, -1.9, 0.010}, RadiansFromDegrees(70),
                                          RadiansFromDegrees(100), 0.5);
  EXPECT_TRUE(MatchesBaseline(pictures->Draw(picture, 256), "view_steep_scope"));
}

// The comparison detects a disturbance, and a quarter more or less of it.
struct Disturbed {
  const char* name;
  double Disturbances::*strength;
  double value;
};
void PrintTo(const Disturbed& disturbed, std::ostream* out) { *out << disturbed.name; }
class DisturbedPicture : public testing::TestWithParam<Disturbed> {};

// The scene with a chequered panorama: what blurs far parts needs edges there.
LoadedScene ChequeredScene() {
  constexpr int kSquare = 48;  // px
  LoadedScene loaded = MakeViewScene();
  ColourImage panorama = *loaded.panorama;
  for (int y = 0; y < panorama.height; ++y)
    for (int x = 0; x < panorama.width; ++x)
      if ((x / kSquare + y / kSquare) % 2 == 1)
        for (int c = 0; c < 3; ++c) panorama.at(x, y)[c] /= 2;
  loaded.panorama = Share(std::move(panorama));
  return loaded;
}

TEST_P(DisturbedPicture, AnotherStrengthIsDetected) {
  START_OR_SKIP(pictures, GetParam().strength == &Disturbances::far_blur ? ChequeredScene()
                                                                         : MakeViewScene());
  Picture picture = ScenePicture();
  // Small enough for all of them.
  picture.instrument->proxy = picture.view.tip + 0.005 * picture.view.view;
  const auto drawn = [&](double value) {
    picture.disturbances = {};
    picture.disturbances.*GetParam().strength = value;
    return pictures->Draw(picture, 176);
  };
  const ColourImage disturbed = drawn(GetParam().value);
  for (const double other : {0.0, 0.75 * GetParam().value, 1.25 * GetParam().value}) {
    const PictureDifference difference = ComparePictures(drawn(other), disturbed);
    EXPECT_FALSE(difference.passes()) << other << ": " << difference.Sentence();
  }
}

INSTANTIATE_TEST_SUITE_P(Each, DisturbedPicture,
                         testing::Values(Disturbed{"haze", &Disturbances::haze, 0.6},
                                         Disturbed{"bubbles", &Disturbances::bubbles, 0.7},
                                         Disturbed{"debris", &Disturbances::debris, 0.8},
                                         Disturbed{"fog", &Disturbances::fog, 0.45},
                                         Disturbed{"near_blur", &Disturbances::near_blur, 0.8},
                                         Disturbed{"far_blur", &Disturbances::far_blur, 0.8},
                                         Disturbed{"overexposure", &Disturbances::overexposure,
                                                   0.5}),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(StillPicture, AMissingProbeIsDetected) {
  START_OR_SKIP(pictures, MakeViewScene());
  Picture picture = ScenePicture();
  const ColourImage with = pictures->Draw(picture, 320);
  picture.instrument.reset();
  const PictureDifference difference = ComparePictures(pictures->Draw(picture, 320), with);
  EXPECT_FALSE(difference.passes()) << difference.Sentence();
}

TEST(StillPicture, TissueAMillimetreOffIsDetected) {
  START_OR_SKIP(pictures, MakeViewScene());
  const ColourImage before = pictures->Draw(ScenePicture(), 320);
  Pose pose = MakeViewScene().scene.tissues[0].pose;
  pose.position.x += 0.001;
  pictures->view().SetTissuePose(0, pose);
  const PictureDifference difference = ComparePictures(pictures->Draw(ScenePicture(), 320), before);
  EXPECT_FALSE(difference.passes()) << difference.Sentence();
}

TEST(StillPicture, HasTheSameBytesInAnotherContext) {
  START_OR_SKIP(first, MakeViewScene());
  const ColourImage picture = first->Draw(ScenePicture(), 200);
  first->Draw(PictureFromPose({0, 0, 0, 0.02}, 0.0, 1.0), 128);
  EXPECT_EQ(first->Draw(ScenePicture(), 200).rgb, picture.rgb) << "whatever was drawn between";
  std::string why_second;
  EXPECT_EQ(Start(MakeViewScene(), &why_second)->Draw(ScenePicture(), 200).rgb, picture.rgb);
}

TEST(StillPicture, PlainShowsNeitherModelsNorLightNorMark) {
  const LoadedScene loaded = MakeViewScene();
  START_OR_SKIP(pictures, loaded);
  Picture picture = ScenePicture();
  picture.plain = true;
  const ColourImage with_models = pictures->Draw(picture, 200);
  pictures->view().SetTissues({}, {});
  picture.instrument.reset();
  EXPECT_EQ(pictures->Draw(picture, 200).rgb, with_models.rgb);
}

// The relief is 46 mm from the portal at most, so a tip at 49 mm is inside the wall.
TEST(StillPicture, AScopeInsideTheWallIsDrawnFromBeforeIt) {
  const LoadedScene loaded = MakeViewScene();
  START_OR_SKIP(pictures, loaded);
  for (const double latitude : {-0.1, 0.0, 0.2}) {
    const simulation::RodPose seen = pictures->Hold({latitude, -0.25, 0, 0.049});
    EXPECT_LT(seen.depth, 0.046 - 0.9 * simulation::ScopeEye::kLensRadius);
    EXPECT_NO_THROW(pictures->Draw(PictureFromPose(seen, 0.0, 1.0), 64));
  }
  const simulation::RodPose free = pictures->Hold({0, 0, 0.4, 0.01});
  EXPECT_EQ(free.depth, 0.01);
  EXPECT_EQ(free.roll, 0.4);
  EXPECT_THROW(pictures->Hold({0, 0, 0, 0.051}), Error);
}

TEST(StillPicture, ATipOutsideTheSphereAndAWrongSizeAreRefused) {
  START_OR_SKIP(pictures, MakeViewScene());
  EXPECT_THROW(pictures->Draw(PictureFromPose({0, 0, 0, 0.051}, 0.0, 1.0), 64), Error);
  EXPECT_THROW(pictures->Draw(PictureFromPose({0, 0, 0, NAN}, 0.0, 1.0), 64), Error);
  EXPECT_THROW(pictures->Draw(ScenePicture(), 4), Error);
  EXPECT_THROW(pictures->Draw(ScenePicture(), 100000), Error);
}

TEST(ComparePictures, EqualPicturesPassAndOneFlatTileOffFails) {
  ColourImage picture(64, 64);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    picture.rgb[i] = static_cast<std::uint8_t>(40 + i * 7 % 90);
  EXPECT_TRUE(ComparePictures(picture, picture).passes());
  EXPECT_EQ(ComparePictures(picture, picture).worst_ssim, 1.0);
  ColourImage flat = picture;
  for (int y = 32; y < 48; ++y)
    for (int x = 16; x < 32; ++x) std::fill_n(flat.at(x, y), 3, std::uint8_t{85});
  const PictureDifference difference = ComparePictures(flat, picture);
  EXPECT_FALSE(difference.passes());
  EXPECT_EQ(difference.worst_tile, glm::ivec2(16, 32));
  EXPECT_FALSE(ComparePictures(ColourImage(64, 63), picture).passes());
  EXPECT_FALSE(ComparePictures({}, {}).passes()) << "nothing is not a picture";
}

TEST(ComparePictures, RoundingDifferencesPass) {
  ColourImage picture(64, 64), rounded;
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    picture.rgb[i] = static_cast<std::uint8_t>(40 + i * 7 % 90);
  rounded = picture;
  for (std::size_t i = 0; i < rounded.rgb.size(); i += 3) rounded.rgb[i] += i % 2;
  EXPECT_TRUE(ComparePictures(rounded, picture).passes());
}

}  // namespace
}  // namespace arthro::test
