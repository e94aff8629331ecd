// The brush that mends the depth map, in the command layer, without a window.
#include "app/steps/depth/depth_brush.h"

#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "app/editor/every_step.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/depth/depth_overlay.h"
#include "app/steps/depth/depth_step.h"
#include "authoring/project/document_io.h"
#include "simulation/core/atomic_file.h"
#include "tests/support/measured_scene.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

using authoring::StrokeKind;

void Settle(EditorState& state) {
  for (int i = 0; i < 60000; ++i) {
    FinishWork(state);
    if (!DepthIsUnderWay(state) && !state.jobs.busy()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  FAIL() << "the work did not end";
}

class DepthBrushMode : public testing::Test {
 protected:
  explicit DepthBrushMode(bool is_estimated = true)
      : state(MakeEditorState([&] {
          authoring::Document document = test::MeasuredDocument();
          if (is_estimated) {
            document.depth = document.depth_sigma = nullptr;
            document.depth_origin = nullptr;
            document.is_depth_imported = false;
          }
          return document;
        }())) {
    Settle(state);
    app::Run(state, "map-brush");
  }
  void Stroke(StrokeKind kind, double radius, const glm::dvec2& from, const glm::dvec2& to) {
    state.steps.depth->board.brush.stroke.kind = kind;
    SetBrushRadius(state, radius);
    PaintDepth(state, from);
    PaintDepth(state, to);
    EndStroke(state);
  }
  double At(int x, int y) const { return static_cast<double>(state.document().depth->at(x, y)); }
  static bool SameBytes(const DepthMap& a, const DepthMap& b) {
    return a.relief.size() == b.relief.size() &&
           std::memcmp(a.relief.data(), b.relief.data(), a.relief.size() * sizeof(float)) == 0;
  }
  EditorState state;
};

class DepthBrushOnMeasuredMap : public DepthBrushMode {
 protected:
  DepthBrushOnMeasuredMap() : DepthBrushMode(false) {}
};

TEST_F(DepthBrushMode, AStrokeIsOneStepAndNeedsNoNewEstimate) {
  const auto before = state.document().depth;
  Stroke(StrokeKind::kRaise, 6, {60, 40}, {66, 40});
  EXPECT_FALSE(DepthIsUnderWay(state));
  EXPECT_FALSE(state.document().is_depth_imported);
  EXPECT_NEAR(At(63, 40) - static_cast<double>(before->at(63, 40)), 1e-3, 1e-8);
  EXPECT_EQ(StrokeCount(state), 1);
  app::Run(state, "undo");
  EXPECT_EQ(state.document().depth, before);
  EXPECT_FALSE(state.history.CanUndo());
  app::Run(state, "redo");
  EXPECT_EQ(StrokeCount(state), 1);
  EXPECT_FALSE(DepthIsUnderWay(state)) << "nothing is computed twice";
}

TEST_F(DepthBrushMode, AppliesItsStrokesAgainWhenTheMapIsMadeAnew) {
  Stroke(StrokeKind::kUnknown, 6, {60, 40}, {66, 40});
  Stroke(StrokeKind::kLower, 6, {30, 40}, {36, 40});
  authoring::DepthOptions options = state.document().depth_options;
  options.estimator = authoring::DepthEstimator::kShading;
  SetDepthOptions(state, options, "Estimator");
  EndDrag(state);
  Settle(state);
  EXPECT_TRUE(std::isnan(At(63, 40)));
  const authoring::EstimatedDepth bare = authoring::EstimateDepth(
      *state.document().panorama, options, nullptr, state.document().scene.backdrop, {});
  EXPECT_NEAR(At(33, 40) - static_cast<double>(bare.depth->at(33, 40)), -1e-3, 1e-8);
}

TEST_F(DepthBrushMode, GivesTheBytesOfAReplay) {
  Stroke(StrokeKind::kRaise, 9, {60, 40}, {80, 60});
  Stroke(StrokeKind::kSmooth, 8, {50, 20}, {80, 60});
  Stroke(StrokeKind::kFlatten, 10, {30, 60}, {40, 60});
  Stroke(StrokeKind::kEdge, 5, {90, 10}, {90, 70});
  Stroke(StrokeKind::kBrightness, 10, {20, 20}, {30, 20});
  const authoring::EstimatedDepth replayed =
      authoring::EstimateDepth(*state.document().panorama, state.document().depth_options,
                               state.document().depth_strokes, state.document().scene.backdrop, {});
  EXPECT_TRUE(SameBytes(*state.document().depth, *replayed.depth));
  ASSERT_EQ(state.document().depth_sigma != nullptr, replayed.sigma != nullptr);
  if (replayed.sigma) {
    EXPECT_TRUE(SameBytes(*state.document().depth_sigma, *replayed.sigma));
  }
}

TEST_F(DepthBrushMode, AMaskMakesTheEstimateAnewAndIsUndone) {
  const auto before = state.document().depth;
  Stroke(StrokeKind::kMask, 8, {60, 40}, {66, 40});
  EXPECT_TRUE(DepthIsUnderWay(state));
  Settle(state);
  EXPECT_NE(state.document().depth, before);
  app::Run(state, "undo");
  EXPECT_EQ(state.document().depth, before);
}

TEST_F(DepthBrushMode, RemovesAllStrokesInOneStep) {
  const DepthMap before = *state.document().depth;
  Stroke(StrokeKind::kRaise, 6, {60, 40}, {66, 40});
  Stroke(StrokeKind::kLower, 6, {30, 40}, {36, 40});
  app::Run(state, "remove-strokes");
  Settle(state);
  EXPECT_EQ(StrokeCount(state), 0);
  EXPECT_TRUE(SameBytes(*state.document().depth, before));
  app::Run(state, "undo");
  EXPECT_EQ(StrokeCount(state), 2);
}

TEST_F(DepthBrushMode, KeysChangeItsSizeAndEscapeLeavesIt) {
  SetBrushRadius(state, 20);
  app::Run(state, "brush-larger");
  EXPECT_NEAR(BrushRadius(state), 25, 1e-9);
  app::Run(state, "brush-smaller");
  app::Run(state, "brush-smaller");
  EXPECT_NEAR(BrushRadius(state), 16, 1e-9);
  PaintDepth(state, {60, 40});
  app::Run(state, "leave-depth-brush");
  EXPECT_FALSE(PaintsDepth(state));
  EndStroke(state);
  EXPECT_FALSE(state.history.CanUndo()) << "a stroke that was left is none";
}

TEST_F(DepthBrushMode, ShowsTheStrokeWhileTheButtonIsDown) {
  state.steps.depth->board.is_shown = true;
  state.steps.depth->board.layer = MapLayer::kShape;
  SetBrushRadius(state, 8);
  PaintDepth(state, {60, 40});
  KeepDepthBoardFresh(state);
  EXPECT_TRUE(state.steps.depth->board.patch.picture);
  const auto& brush = state.steps.depth->board.brush;
  EXPECT_NEAR(brush.growing->depth().relief.at(60, 40) - brush.growing->before().relief.at(60, 40),
              1e-3, 1e-8);
  EndStroke(state);
  KeepDepthBoardFresh(state);
  EXPECT_FALSE(state.steps.depth->board.patch.picture);
}

// A stroke over the width of the map: each piece computes and draws its surround, not the stroke.
TEST_F(DepthBrushMode, APieceOfAStrokeDrawsItsSurroundOnly) {
  state.steps.depth->board.is_shown = true;
  state.steps.depth->board.layer = MapLayer::kShape;
  SetBrushRadius(state, 3);
  const auto& board = state.steps.depth->board;
  for (int x = 8; x < test::kMeasuredWidth - 8; x += 4) {
    PaintDepth(state, {x, 30 + 0.1 * x});
    KeepDepthBoardFresh(state);
    const PixelBounds& box = board.patch.box;
    // The piece with its radius and the rim of slopes on either side, and a strip of a few columns
    // and rows by which the box grew.
    const int side = 4 + 2 * (3 + kShapeReach + 1) + 4;
    EXPECT_LE(board.patch.drawn, side * side + 8 * (box.width() + box.height())) << x;
    ASSERT_TRUE(board.patch.picture);
    EXPECT_EQ(board.patch.picture->width, box.width());
  }
  // The patch that was drawn piece by piece is that of the whole stroke.
  const ColourImage pieces = *board.patch.picture;
  const CoarseMap coarse{board.brush.growing->depth().relief, *board.brush.coarse_picture,
                         board.brush.stride};
  EXPECT_EQ(pieces.rgb,
            DrawCoarse(state.document(), MapLayer::kShape, coarse, board.patch.box).rgb);
}

TEST_F(DepthBrushMode, StrokesAreKeptInTheSavedScene) {
  const test::TempFolder temp;
  Stroke(StrokeKind::kRaise, 6, {60, 40}, {66, 40});
  authoring::SaveDocument(state.document(), temp / "scene");
  const authoring::Document saved = authoring::OpenDocument(temp / "scene");
  EXPECT_FALSE(saved.is_depth_imported);
  ASSERT_TRUE(saved.depth_strokes);
  EXPECT_EQ(*saved.depth_strokes, *state.document().depth_strokes);
  EXPECT_TRUE(SameBytes(*saved.depth, *state.document().depth));
}

TEST_F(DepthBrushMode, APanoramaOfAnotherShapeDropsTheStrokes) {
  Stroke(StrokeKind::kRaise, 6, {60, 40}, {66, 40});
  SetPanorama(state, "Larger", Share(ColourImage(242, 162)));
  EXPECT_EQ(StrokeCount(state), 1);
  SetPanorama(state, "Other", Share(ColourImage(242, 100)));
  EXPECT_EQ(StrokeCount(state), 0);
}

TEST_F(DepthBrushMode, AReliefBeyondTheBackdropIsRefusedInASentence) {
  const authoring::DepthOptions before = state.document().depth_options;
  authoring::DepthOptions options = before;
  options.near_relief = 0.131;  // the backdrop lies at 40 mm
  SetDepthOptions(state, options, "Near relief");
  EXPECT_EQ(state.document().depth_options.near_relief, before.near_relief);
  EXPECT_NE(state.message.find("131.0 mm was refused"), std::string::npos) << state.message;
  EXPECT_NE(state.message.find("38.0 mm at most"), std::string::npos) << state.message;
  options.near_relief = 0.037;
  SetDepthOptions(state, options, "Near relief");
  EXPECT_EQ(state.document().depth_options.near_relief, 0.037);
}

TEST_F(DepthBrushOnMeasuredMap, KeepsTheMapAnImportedOne) {
  Stroke(StrokeKind::kRaise, 6, {100, 60}, {104, 60});
  EXPECT_TRUE(state.document().is_depth_imported);
  EXPECT_EQ(state.document().depth_origin->at(102, 60), ReliefOrigin::kInterpolated);
  authoring::DepthOptions options = state.document().depth_options;
  options.gamma = 1.5;
  const auto mended = state.document().depth;
  SetDepthOptions(state, options, "Gamma");
  EXPECT_EQ(state.document().depth, mended) << "a slider never replaces an imported map";
}

TEST_F(DepthBrushOnMeasuredMap, StrokesAreDataAndAreRemoved) {
  const authoring::Document before = state.document();
  Stroke(StrokeKind::kRaise, 6, {100, 60}, {104, 60});
  Stroke(StrokeKind::kMask, 5, {40, 40}, {44, 44});
  Stroke(StrokeKind::kUnknown, 4, {20, 20}, {24, 20});
  const authoring::Document mended = state.document();
  EXPECT_EQ(StrokeCount(state), 3);
  EXPECT_EQ(mended.unmended.depth, before.depth);
  // The strokes and the map before them give the map.
  const auto& backdrop = before.scene.backdrop;
  authoring::MendedDepth replayed{*mended.unmended.depth, *mended.unmended.sigma,
                                  *mended.unmended.origin};
  for (const authoring::DepthStroke& stroke : *mended.depth_strokes)
    authoring::ApplyStroke(stroke, {*before.panorama, backdrop.projection, backdrop.radius},
                           replayed);
  EXPECT_TRUE(SameBytes(replayed.relief, *mended.depth));
  EXPECT_TRUE(SameBytes(replayed.sigma, *mended.depth_sigma));
  app::Run(state, "remove-strokes");
  EXPECT_EQ(state.document().depth, before.depth);
  EXPECT_EQ(state.document().depth_sigma, before.depth_sigma);
  EXPECT_EQ(state.document().depth_origin, before.depth_origin);
  EXPECT_EQ(StrokeCount(state), 0);
  app::Run(state, "undo");
  EXPECT_EQ(StrokeCount(state), 3);
  EXPECT_EQ(state.document().depth, mended.depth);
}

TEST_F(DepthBrushOnMeasuredMap, StrokesAreDataInTheSavedSceneAndItsArchive) {
  const test::TempFolder temp;
  const DepthMap before = *state.document().depth;
  authoring::Document saved = authoring::SaveDocument(state.document(), temp / "scene");
  state.history.Amend(saved);
  Stroke(StrokeKind::kRaise, 6, {60, 40}, {66, 40});
  saved = authoring::SaveDocument(state.document(), temp / "scene");
  EXPECT_EQ(saved.unmended.depth_file, "depth.tiff") << "the file of the map before is kept";
  saved = authoring::SaveDocument(saved, temp / "scene.arthro");
  std::filesystem::create_directory(temp / "bare");
  for (const char* place : {"scene", "scene.arthro"}) {
    authoring::Document opened = authoring::OpenDocument(temp / place);
    ASSERT_TRUE(opened.is_depth_imported) << place;
    ASSERT_TRUE(opened.depth_strokes) << place;
    ASSERT_TRUE(opened.unmended.depth) << place;
    EXPECT_TRUE(SameBytes(*opened.unmended.depth, before)) << place;
    EXPECT_TRUE(SameBytes(*opened.depth, *state.document().depth)) << place;
    EditorState next = MakeEditorState(std::move(opened));
    RemoveStrokes(next);
    EXPECT_TRUE(SameBytes(*next.document().depth, before)) << place;
    // Without strokes the copy holds one map.
    authoring::SaveDocument(next.document(), temp / "bare" / place);
  }
  EXPECT_FALSE(std::filesystem::exists(temp / "bare" / "scene" / "depth-2.tiff"));
}

TEST_F(DepthBrushOnMeasuredMap, AMapWhoseStrokesCannotBeReadHoldsThem) {
  const test::TempFolder temp;
  Stroke(StrokeKind::kRaise, 6, {60, 40}, {66, 40});
  const authoring::Document saved = authoring::SaveDocument(state.document(), temp / "scene");
  WriteAtomically(temp / "scene" / saved.unmended.depth_file, "no depth map");
  const authoring::Document opened = authoring::OpenDocument(temp / "scene");
  EXPECT_TRUE(SameBytes(*opened.depth, *state.document().depth));
  EXPECT_FALSE(opened.depth_strokes);
  EXPECT_FALSE(opened.unmended.depth);
}

TEST_F(DepthBrushOnMeasuredMap, TouchPreviewGivesTheForceOfASession) {
  // On the bare sphere beside the bump: the normal points to the portal.
  TouchProbe probe(state.document(), {});
  const glm::dvec3 point =
      test::kMeasuredRadius *
      DirectionFromPixel(state.document().scene.backdrop.projection, glm::dvec2(45, 40));
  const TouchReading soft = probe.Press(point, 1e-3), hard = probe.Press(point, 3e-3);
  EXPECT_TRUE(soft.is_reached);
  EXPECT_GT(soft.tip_force, 0.1);
  EXPECT_GT(hard.tip_force, 2 * soft.tip_force);
  EXPECT_GT(-glm::dot(soft.normal, glm::normalize(point)), 0.98);
  // The stiffness of the coupling, softened by the uncertainty of the map, never more.
  EXPECT_LE(soft.stiffness, simulation::ContactOptions().stiffness * 1.02);
  EXPECT_GT(soft.stiffness, 0.2 * simulation::ContactOptions().stiffness);
  // Pressed far too deep, the limiter of the session holds the force.
  const TouchReading deep = probe.Press(point, 20e-3);
  EXPECT_LE(deep.force, simulation::LimiterOptions().max_force + 1e-9);
}

// It read the relief behind it.
TEST_F(DepthBrushOnMeasuredMap, TouchPreviewReadsATissueInFrontOfTheRelief) {
  Edit(state, "Ball", "", [](authoring::Document& next) {
    Tissue& tissue = next.scene.tissues.emplace_back();
    tissue.name = "ball";
    tissue.pose.position = {0, 0, 0.025};
    next.surfaces.push_back(Share(test::Sphere({0, 0, 0}, 5e-3, 4)));
  });
  Settle(state);
  const authoring::Sight onto{{0, 0, 0}, {0, 0, 1}, 1000};
  const authoring::Sight beside{{0, 0, 0}, glm::normalize(glm::dvec3(-0.4, 0, 1)), 1000};
  TouchProbe rigid(state.document(), {}), soft(state.document(), {}, {500.0});
  const auto hit = rigid.TissueAlong(onto, 0.04);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->tissue, 0);
  EXPECT_NEAR(hit->point.z, 0.02, 2e-5) << "the triangles lie a little inside of the sphere";
  EXPECT_LT(hit->normal.z, -0.99);
  EXPECT_FALSE(rigid.TissueAlong(beside, 0.04));
  const TouchReading hard = rigid.PressTissue(hit->point, 0, hit->normal, 1e-3),
                     yields = soft.PressTissue(hit->point, 0, hit->normal, 1e-3);
  EXPECT_GT(hard.tip_force, 0.1);
  EXPECT_GT(-hard.normal.z, 0.98);
  // Springs in series: the contact and 500 N/m.
  EXPECT_NEAR(1 / yields.stiffness, 1 / hard.stiffness + 1 / 500.0, 0.05 / 500.0);
  EXPECT_NEAR(yields.tip_force, 1e-3 * yields.stiffness, 0.1 * yields.tip_force);
  EXPECT_LT(yields.tip_force, hard.tip_force);

  // The command and the words.
  app::Run(state, "touch-preview");
  for (int i = 0; i < 3; ++i) Settle(state);
  ASSERT_TRUE(state.steps.depth->touch.probe);
  TouchAlong(state, onto);
  ASSERT_TRUE(state.steps.depth->touch.reading);
  EXPECT_EQ(state.steps.depth->touch.reading->tissue, 0);
  EXPECT_EQ(WordsOfTouch(state, *state.steps.depth->touch.reading).substr(0, 8), "ball: 20");
  TouchAlong(state, beside);
  ASSERT_TRUE(state.steps.depth->touch.reading);
  EXPECT_EQ(state.steps.depth->touch.reading->tissue, -1);
}

// A flat end on a half space: 2 a E / (1 - nu^2) [Sneddon 1965].
TEST_F(DepthBrushOnMeasuredMap, TipStiffnessIsThatOfTheMaterial) {
  Scene scene;
  scene.tissues.resize(2);
  scene.tissues[0].material = "rubber";
  scene.tissues[1].material = "unknown";
  std::vector<simulation::TissuePreset> presets(1);
  presets[0].name = "rubber";
  presets[0].material.young_modulus = 5e5;
  presets[0].material.poisson_ratio = 0.4;
  const auto stiffness = TipStiffness(scene, presets);
  ASSERT_EQ(stiffness.size(), 2u);
  EXPECT_NEAR(stiffness[0], 2 * 5e-4 * 5e5 / 0.84, 1e-9);
  EXPECT_EQ(stiffness[1], 0);
}

TEST_F(DepthBrushOnMeasuredMap, AnImportedFileReplacesTheMapAfterItsMeaningWasGiven) {
  const test::TempFolder temp;
  cv::Mat map(test::kMeasuredHeight, test::kMeasuredWidth, CV_16U, cv::Scalar(32768));
  cv::imwrite((temp / "d.png").string(), map);
  const auto before = state.document().depth;
  ChooseDepthImport(state, temp / "d.png");
  Settle(state);
  EXPECT_EQ(state.document().depth, before) << "asked first";
  ASSERT_TRUE(state.steps.depth->import);
  state.steps.depth->import->options.low = 0.02;
  state.steps.depth->import->options.high = 0.04;
  EXPECT_EQ(WordsOfImport(state), "The tissue will lie 30.0 to 30.0 mm from the portal.");
  app::Run(state, "take-depth-import");
  EXPECT_NEAR(At(60, 40), 0.01, 1e-6);
  EXPECT_TRUE(state.document().is_depth_imported);
  app::Run(state, "undo");
  EXPECT_EQ(state.document().depth, before);
}

}  // namespace
}  // namespace arthro::app
