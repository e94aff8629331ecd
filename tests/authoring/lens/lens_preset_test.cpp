#include "authoring/lens/lens_preset.h"

#include <cmath>

#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/core/units.h"

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

TEST(LensPreset, EveryPresetReads) { EXPECT_GE(ReadLensPresets(kPresets).size(), 2u); }

TEST(LensPreset, NeedsAWindowAndAFile) {
  const LensPreset preset = ReadLensPreset(kPresets / "linvatec_hd4300_4mm.json");
  EXPECT_THROW(LensFromPreset(preset, 800, 640, {}), Error);
  EXPECT_THROW(ReadLensPreset(kPresets / "none.json"), Error);
  EXPECT_THROW(ReadLensPresets(kPresets / "none"), Error);
}

}  // namespace
}  // namespace arthro::authoring
