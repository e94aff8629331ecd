// Lens and field of view of the scope in the Portals step, without a window.
#include "app/steps/portals/scope_lens.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/state/edits.h"
#include "simulation/core/units.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/json/lens_io.h"
#include "simulation/scope/window_lens.h"
#include "tests/app/commands/settle.h"
#include "tests/support/build_paths.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

class ScopeLens : public testing::Test {
 protected:
  void SetUp() override {
    OpenScene(state, test::WriteSmallScene(temp / "knee"));
    Settle();
    ASSERT_TRUE(state.dialogs.empty());
  }
  void Settle() { app::Settle(state); }
  double DrawnField() const {
    return simulation::OpticsOf(state.document().scene.scope, state.document().lens).field_of_view;
  }
  const LensChoice& Preset(double view_angle_deg) {
    for (const LensChoice& choice : lenses)
      if (choice.preset && choice.preset->view_angle &&
          std::abs(DegreesFromRadians(*choice.preset->view_angle) - view_angle_deg) < 1e-9)
        return choice;
    throw std::out_of_range("no such preset");
  }

  test::TempFolder temp;
  EditorState state = MakeEditorState(NewDocument());
  const std::vector<LensChoice> lenses =
      ScopeLenses(std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources/presets/lenses");
};

TEST_F(ScopeLens, EquisolidIsFirstAndEveryPresetHasALens) {
  ASSERT_GE(lenses.size(), 6u);
  EXPECT_FALSE(lenses[0].lens);
  for (std::size_t i = 1; i < lenses.size(); ++i) {
    EXPECT_TRUE(lenses[i].lens) << lenses[i].words;
    EXPECT_EQ(lenses[i].problem, "");
  }
  EXPECT_EQ(ChosenScopeLens(lenses, state), 0);
}

TEST_F(ScopeLens, PresetGivesItsFieldItsCameraAndItsViewAngleAndCanBeUndone) {
  const double before = DrawnField();
  const LensChoice& preset = Preset(70);
  ChooseScopeLens(state, preset);
  ASSERT_TRUE(state.dialogs.empty());
  EXPECT_NEAR(DrawnField(), preset.preset->field_of_view, 1e-9);
  EXPECT_NEAR(state.document().scene.scope.field_of_view, preset.preset->field_of_view, 1e-9);
  EXPECT_NEAR(state.document().scene.scope.view_angle, RadiansFromDegrees(70), 1e-12);
  EXPECT_EQ(state.document().lens->camera, preset.preset->camera);
  app::Run(state, "save");
  Settle();
  const LoadedScene saved = LoadScene(temp / "knee");
  ASSERT_TRUE(saved.lens);
  EXPECT_EQ(saved.lens->camera, preset.preset->camera);
  EXPECT_NEAR(saved.lens->field_of_view, preset.preset->field_of_view, 1e-9);
  app::Run(state, "undo");
  EXPECT_NEAR(DrawnField(), before, 1e-12);
  EXPECT_FALSE(state.document().lens);
}

// The lens has precedence over the field of the scene, so that setting the latter alone did
// nothing.
TEST_F(ScopeLens, FieldOfViewChangesWhatIsDrawnWithAnyLens) {
  for (const LensChoice& choice : lenses) {
    ChooseScopeLens(state, choice);
    EndDrag(state);
    SetFieldOfView(state, RadiansFromDegrees(50));
    EndDrag(state);
    EXPECT_NEAR(DrawnField(), RadiansFromDegrees(50), 1e-9) << choice.words;
  }
}

TEST_F(ScopeLens, FieldBeyondTheEndOfALensIsRefused) {
  Lens pinhole;
  pinhole.model = LensModel::kPinhole;
  pinhole.width = pinhole.height = 800;
  pinhole.focal_px = 400;
  pinhole.cx = pinhole.cy = 399.5;
  pinhole.field_of_view = RadiansFromDegrees(80);
  pinhole.circle = {399.5, 399.5, 400 * std::tan(RadiansFromDegrees(40))};
  WriteLens(temp / "pinhole.json", pinhole);
  ChooseScopeLens(state, LensFromFile(temp / "pinhole.json"));
  EXPECT_FALSE(ChosenScopeLens(lenses, state));
  EXPECT_NE(WordsOfScopeLens(state).find("pinhole"), std::string::npos);
  SetFieldOfView(state, std::numbers::pi);
  EXPECT_NEAR(DrawnField(), RadiansFromDegrees(80), 1e-9);
}

TEST_F(ScopeLens, LensThatCannotBeDrawnIsRefusedInASentence) {
  Lens broken;
  broken.model = LensModel::kPinhole;
  broken.width = broken.height = 800;
  broken.focal_px = 400;
  broken.cx = broken.cy = 399.5;
  broken.field_of_view = RadiansFromDegrees(200);
  ChooseScopeLens(state, {"broken", "", broken});
  EXPECT_EQ(state.dialogs.size(), 1u);
  EXPECT_FALSE(state.document().lens);
}

TEST_F(ScopeLens, FillingIsAnEditOfTheScene) {
  SetMedium(state, Medium::kGas);
  EXPECT_EQ(state.document().scene.backdrop.medium, Medium::kGas);
  app::Run(state, "undo");
  EXPECT_EQ(state.document().scene.backdrop.medium, Medium::kSaline);
}

}  // namespace
}  // namespace arthro::app
