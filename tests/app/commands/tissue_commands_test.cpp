// Commands of tissues: import, place, balls, material and poking.
#include <fstream>

#include <gtest/gtest.h>

#include "app/steps/portals/portals_step.h"
#include "app/steps/practice/hand_motion.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/tissue/tissue_balls.h"
#include "app/steps/tissue/tissue_step.h"
#include "tests/app/commands/command_test.h"
#include "tests/support/build_paths.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

TEST_F(Commands, AnImportedSurfaceIsPlacedFirst) {
  Open();
  state.steps.tissue->page = TissuePage::kCut;
  ImportSurface(state, "cartilage", *state.document().surfaces.front(), "m");
  EXPECT_EQ(state.step, Step::kTissue);
  EXPECT_EQ(state.steps.tissue->page, TissuePage::kPlace);
}

// An empty file is refused before anything is asked about it.
TEST_F(Commands, ASurfaceThatCannotBeReadIsRefusedBeforeItsUnitIsAsked) {
  Open();
  std::ofstream(temp / "empty.obj");
  AskForUnit(state, temp / "empty.obj");
  Settle(state);
  ASSERT_EQ(state.dialogs.size(), 1u);
  ASSERT_TRUE(std::holds_alternative<ErrorDialog>(state.dialogs.back()));
  EXPECT_NE(std::get<ErrorDialog>(state.dialogs.back()).sentence.find("empty"), std::string::npos);
}

TEST_F(Commands, ATissueBehindTheReliefIsFoundAndBroughtBack) {
  Open();
  EXPECT_FALSE(IsHidden(state, 0));
  Tissue changed = state.document().scene.tissues[0];
  changed.pose.position *= 3.0;
  SetTissue(state, 0, changed, "Move");
  EndDrag(state);
  EXPECT_TRUE(IsHidden(state, 0));
  app::Run(state, "tissue-before-scope");
  EXPECT_FALSE(IsHidden(state, 0));
  app::Run(state, "undo");
  EXPECT_TRUE(IsHidden(state, 0));
  EXPECT_FALSE(IsHidden(state, 7)) << "there is none";
}

TEST_F(Commands, ASurfaceIsReadInItsUnitAndLaidBeforeTheScope) {
  Open();
  SurfaceMesh mesh = test::Octahedron(5.0);  // mm
  for (auto& x : mesh.vertices) x += glm::dvec3(100, 0, 0);
  WriteSurface(temp / "part.ply", mesh);
  AskForUnit(state, temp / "part.ply");
  Settle(state);
  ASSERT_EQ(state.dialogs.size(), 1u);
  const auto dialog = std::get<UnitDialog>(state.dialogs.back());
  state.dialogs.clear();
  EXPECT_DOUBLE_EQ(dialog.longest_side, 10.0);
  EXPECT_EQ(dialog.unit, "mm");
  ImportSurface(state, "part", *dialog.surface, dialog.unit);
  ASSERT_EQ(state.document().scene.tissues.size(), 2u);
  EXPECT_EQ(state.tissue, 1);
  EXPECT_EQ(state.document().scene.tissues[1].name, "part");
  const auto& surface = *state.document().surfaces[1];
  EXPECT_NEAR(glm::length(surface.vertices[0]), 0.005, 1e-12) << "5 mm about its own middle";
  EXPECT_GT(state.document().scene.tissues[1].pose.position.z, 0.01);

  app::Run(state, "duplicate-tissue");
  EXPECT_EQ(state.document().scene.tissues[2].name, "part 2");
  EXPECT_EQ(state.document().surfaces[2], state.document().surfaces[1]) << "shared, not copied";
  app::Run(state, "remove-tissue");
  app::Run(state, "remove-tissue");
  EXPECT_EQ(state.document().scene.tissues.size(), 1u);
  app::Run(state, "undo");
  EXPECT_EQ(state.document().scene.tissues.size(), 2u);
}

// Two tetrahedra on a common face, in mm.
TEST_F(Commands, AVolumeIsImportedWithItsTetrahedra) {
  Open();
  TetMesh mesh;
  mesh.rest_positions = {{100, 0, 0}, {110, 0, 0}, {100, 10, 0}, {100, 0, 10}, {100, 0, -10}};
  mesh.elements = {0, 1, 2, 3, 0, 2, 1, 4};
  WriteTetMesh(temp / "meniscus.vtu", mesh);
  OpenDropped(state, temp / "meniscus.vtu");
  Settle(state);
  ASSERT_EQ(state.dialogs.size(), 1u);
  const auto dialog = std::get<UnitDialog>(state.dialogs.back());
  state.dialogs.clear();
  EXPECT_EQ(dialog.unit, "mm");
  EXPECT_EQ(dialog.surface->triangles.size(), 6u);
  ImportSurface(state, dialog.file, *dialog.surface, dialog.unit, dialog.tetrahedra.get());
  ASSERT_EQ(state.document().scene.tissues.size(), 2u);
  EXPECT_FALSE(state.document().scene.tissues[1].mesh.empty());
  app::Run(state, "save");
  Settle(state);
  const LoadedScene saved = LoadScene(temp / "knee");
  const TetMesh own = ReadTetMesh(temp / "knee" / saved.scene.tissues[1].mesh);
  EXPECT_EQ(own.elements, mesh.elements);
  ASSERT_EQ(saved.surfaces[1]->vertices.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_LT(glm::distance(own.rest_positions[i], saved.surfaces[1]->vertices[i]), 1e-8)
        << "m; a surface file holds single precision";
  app::Run(state, "undo");
  EXPECT_EQ(state.document().scene.tissues.size(), 1u);
}

TEST_F(Commands, BallsThatHoldATissueAreAddedMovedAndReleasedStepByStep) {
  Open();
  state.tissue = 0;
  state.steps.tissue->ball_radius = 0.003;
  AddBall(state, BallKind::kHeld, 0, {0.006, 0, 0});
  AddBall(state, BallKind::kHeld, 0, {0, 0.006, 0});
  const auto& fixed = [&]() -> const std::vector<Ball>& {
    return state.document().scene.tissues[0].fixed;
  };
  ASSERT_EQ(fixed().size(), 2u);
  EXPECT_EQ(state.steps.tissue->ball, 1);
  EXPECT_EQ(fixed()[0], (Ball{{0.006, 0, 0}, 0.003}));
  SetBall(state, BallKind::kHeld, 0, 1, {{0, 0.006, 0}, 0.001}, "Change a ball of");
  EXPECT_EQ(fixed()[1].radius, 0.001);
  EndDrag(state);
  app::Run(state, "undo");
  EXPECT_EQ(fixed()[1].radius, 0.003);
  app::Run(state, "undo");
  EXPECT_EQ(fixed().size(), 1u) << "each ball is a step of its own";
  app::Run(state, "redo");
  state.steps.tissue->ball = 0;
  state.steps.tissue->page = TissuePage::kHold;
  app::Run(state, "release-ball");
  ASSERT_EQ(fixed().size(), 1u);
  EXPECT_EQ(fixed()[0].centre, glm::dvec3(0, 0.006, 0));
  app::Run(state, "release-tissue");
  EXPECT_TRUE(fixed().empty());
  EXPECT_FALSE(CommandOf(state, "release-tissue").enabled(state));
  app::Run(state, "undo");
  EXPECT_EQ(fixed().size(), 1u);
}

TEST_F(Commands, ProbedPlacesAreBallsOfTheirOwn) {
  Open();
  state.tissue = 0;
  state.steps.tissue->page = TissuePage::kMesh;
  state.steps.tissue->ball_radius = 0.0015;
  AddBall(state, BallKind::kHeld, 0, {0.006, 0, 0});
  AddBall(state, BallKind::kProbed, 0, {0, 0.006, 0});
  const auto& tissue = [&]() -> const Tissue& { return state.document().scene.tissues[0]; };
  EXPECT_EQ(tissue().fixed, (std::vector<Ball>{{{0.006, 0, 0}, 0.0015}}));
  EXPECT_EQ(tissue().probed, (std::vector<Ball>{{{0, 0.006, 0}, 0.0015}}));
  EXPECT_EQ(state.steps.tissue->ball, 0);
  EXPECT_FALSE(CommandOf(state, "release-ball").enabled(state))
      << "the page is about the probed ones";
  app::Run(state, "remove-probed");
  EXPECT_TRUE(tissue().probed.empty());
  EXPECT_EQ(tissue().fixed.size(), 1u);
  EXPECT_EQ(state.history.UndoName(), "Take a probed place from " + tissue().name);
  app::Run(state, "undo");
  app::Run(state, "remove-all-probed");
  EXPECT_TRUE(tissue().probed.empty());
  EXPECT_FALSE(CommandOf(state, "remove-all-probed").enabled(state));
  app::Run(state, "probe-brush");
  EXPECT_EQ(state.steps.tissue->brush, BallKind::kProbed);
  app::Run(state, "hold-brush");
  EXPECT_EQ(state.steps.tissue->brush, BallKind::kHeld) << "one brush at a time";
  app::Run(state, "hold-brush");
  EXPECT_FALSE(state.steps.tissue->brush);
}

TEST_F(Commands, ABallAtTheInstrumentLiesAtItsTipInTheTissuesOwnFrame) {
  Open();
  state.tissue = 0;
  Tissue turned = state.document().scene.tissues[0];
  turned.pose.quaternion = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)));
  turned.pose.scale = 2;
  SetTissue(state, 0, turned, "Turn");
  app::Run(state, "hold-at-instrument");
  const Tissue& tissue = state.document().scene.tissues[0];
  ASSERT_EQ(tissue.fixed.size(), 1u);
  const glm::dvec3 tip = glm::dvec3(0.03, 0, 0) + simulation::TipInOwnPortal(state.instrument);
  EXPECT_LT(glm::distance(tissue.pose * tissue.fixed[0].centre, tip), 1e-12);
  EXPECT_NEAR(tissue.fixed[0].radius * 2, state.steps.tissue->ball_radius, 1e-15);
}

TEST_F(Commands, MaterialsArePresetsAndWhatTheSceneSaysOtherwise) {
  Open();
  state.steps.tissue->preset_folder = fs::path(ARTHRO_SOURCE_DIR) / "resources/presets/tissues";
  LoadTissuePresets(state);
  ASSERT_EQ(state.tissue_presets.size(), 6u);
  const auto tissue = [&]() -> const Tissue& { return state.document().scene.tissues[0]; };
  Elasticity own;
  own.young_modulus = 3e5;
  SetElasticity(state, 0, own, "Change");
  EXPECT_EQ(PresetOf(state, tissue())->material.young_modulus, 3e5);
  EXPECT_EQ(PresetOf(state, tissue())->material.fibre_stiffness, 2e7);
  own.young_modulus = 5e5;  // the preset's own
  SetElasticity(state, 0, own, "Change");
  EXPECT_EQ(tissue().elasticity, Elasticity{});
  own.poisson_ratio = 0.3;
  SetElasticity(state, 0, own, "Change");
  EndDrag(state);
  ChoosePreset(state, 0, "cartilage-literature");
  EXPECT_EQ(tissue().elasticity, Elasticity{});
  EXPECT_EQ(PresetOf(state, tissue())->material.young_modulus, 1.5e7);
  app::Run(state, "undo");
  EXPECT_EQ(tissue().material, "meniscus");
  EXPECT_EQ(tissue().elasticity.poisson_ratio, 0.3);
  Tissue unknown = tissue();
  unknown.material = "jelly";
  EXPECT_FALSE(PresetOf(state, unknown));
}

TEST_F(Commands, ABrokenPresetIsToldOnce) {
  Open();
  std::ofstream(temp / "bad.json") << "{";
  state.steps.tissue->preset_folder = temp.path();
  LoadTissuePresets(state);
  LoadTissuePresets(state);
  EXPECT_EQ(state.dialogs.size(), 1u);
}

// The poke's session has the author's hands: the instrument stops at the tissue, and the force is
// felt.
TEST_F(Commands, PokingHoldsTheInstrumentOutOfTheTissueUntilAnEditEndsIt) {
  Open();
  app::Run(state, "poke");
  Settle(state);
  ASSERT_TRUE(state.steps.practice->poke);
  ASSERT_FALSE(state.practice);
  EXPECT_EQ(LiveSession(state), &*state.steps.practice->poke);
  // Towards the joint's surface until it must have met it.
  state.instrument = {0.0, -0.5, 0.0, 0.046};
  MoveHands(state, {}, {0, 0, 0, 0.001});
  for (int i = 0; i < 30; ++i) state.steps.practice->poke->Advance(0.016);
  EXPECT_GT(glm::length(state.steps.practice->poke->snapshot().instrument.tip_force), 0.05);
  EXPECT_EQ(state.instrument.depth, 0.047) << "the author's own hand is what moved";
  FinishWork(state);
  EXPECT_TRUE(state.steps.practice->poke);
  SetTitle(state, "another");
  FinishWork(state);
  EXPECT_FALSE(state.steps.practice->poke);
  app::Run(state, "poke");
  Settle(state);
  ASSERT_TRUE(state.steps.practice->poke);
  app::Run(state, "poke");
  EXPECT_FALSE(state.steps.practice->poke) << "the same command ends it";
}

}  // namespace
}  // namespace arthro::app
