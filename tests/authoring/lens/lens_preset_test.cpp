#include "authoring/lens/lens_preset.h"

#include <cmath>

#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "tests/support/build_paths.h"

namespace arthro::authoring {
namespace {

const std::filesystem::path kPresets =
    std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources/presets/lenses";

TEST(LensPreset, TheLensOfThePaperFillsTheWindow) {
  const LensPreset preset = ReadLensPreset(kPresets / "linvatec_hd4300_4mm.json");
  EXPECT_EQ(preset.model, LensModel::kEquisolid);
  EXPECT_FALSE(preset.known.empty());
  EXPECT_FALSE(preset.assumed.empty());
  const Lens lens = LensFromPreset(preset, 800, 640, {402.5, 317.5, 300});
  EXPECT_NEAR(2 * lens.focal_px * std::sin(preset.field_of_view / 4), 300, 1e-9);
  EXPECT_NEAR(*FieldOfViewOf(lens), preset.field_of_view, 1e-9);
}

TEST(LensPreset, EveryPresetReadsAndFillsAWindow) {
  EXPECT_GE(ReadLensPresets(kPresets).size(), 5u);
  for (const LensPreset& preset : ReadLensPresets(kPresets)) {
    const Lens lens = LensFromPreset(preset, 1080, 1080, {539.5, 539.5, 540});
    EXPECT_NEAR(*FieldOfViewOf(lens), preset.field_of_view, 1e-9) << preset.name;
    EXPECT_EQ(lens.camera, preset.camera) << preset.name;
  }
}

// A prism that turns the view by 70 degrees, and the noise of a thin scope.
TEST(LensPreset, StatesTheViewAngleAndTheCameraOfItsScope) {
  const LensPreset steep = ReadLensPreset(kPresets / "arthroscope_4mm_70_saline.json");
  ASSERT_TRUE(steep.view_angle);
  EXPECT_NEAR(*steep.view_angle, RadiansFromDegrees(70), 1e-12);
  EXPECT_EQ(ReadLensPreset(kPresets / "arthroscope_2_7mm_30_saline.json").camera.grain, 2);
  EXPECT_FALSE(ReadLensPreset(kPresets / "linvatec_hd4300_4mm.json").view_angle);
}

TEST(LensPreset, NeedsAWindowAndAFile) {
  const LensPreset preset = ReadLensPreset(kPresets / "linvatec_hd4300_4mm.json");
  EXPECT_THROW(LensFromPreset(preset, 800, 640, {}), Error);
  EXPECT_THROW(ReadLensPreset(kPresets / "none.json"), Error);
  EXPECT_THROW(ReadLensPresets(kPresets / "none"), Error);
}

}  // namespace
}  // namespace arthro::authoring
