// The map of the depth in the command layer, without a window.
#include "app/steps/depth/depth_board.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/state/command.h"
#include "app/steps/depth/depth_overlay.h"
#include "app/steps/depth/depth_step.h"
#include "authoring/project/document_io.h"
#include "tests/support/measured_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

class DepthMapBoard : public testing::Test {
 protected:
  DepthBoard& board() { return state.steps.depth->board; }
  double Distance(const glm::dvec2& a, const glm::dvec2& b) const {
    const authoring::ReliefView view = ReliefViewOf(state.document());
    return glm::distance(authoring::ReadRelief(view, a).point,
                         authoring::ReadRelief(view, b).point);
  }
  std::string WordsAt(const glm::dvec2& pixel) const {
    return WordsOfReading(state.document(),
                          authoring::ReadRelief(ReliefViewOf(state.document()), pixel));
  }
  void GiveLength(LengthKind kind, double mm) {
    app::Run(state, "map-length");
    board().kind = kind;
    ClickDepth(state, {60, 20});
    ClickDepth(state, {100, 60});
    board().length().metres = mm * 1e-3;
    app::Run(state, "set-scale");
  }
  std::string TakeRefusal() {
    if (state.dialogs.size() != 1) return "";
    const std::string sentence = std::get<ErrorDialog>(state.dialogs[0]).sentence;
    state.dialogs.clear();
    return sentence;
  }
  EditorState state = MakeEditorState(test::MeasuredDocument());
};

TEST_F(DepthMapBoard, IsShownByItsCommandsOnly) {
  EXPECT_FALSE(ShowsDepthBoard(state));
  app::Run(state, "map-sigma");
  EXPECT_TRUE(ShowsDepthBoard(state));
  EXPECT_EQ(state.step, Step::kDepth);
  app::Run(state, "depth-scope");
  EXPECT_FALSE(ShowsDepthBoard(state));
  app::Run(state, "depth-map");
  state.step = Step::kPanorama;
  EXPECT_FALSE(ShowsDepthBoard(state));
}

TEST_F(DepthMapBoard, ReadsRangeUncertaintyAndOriginAtAClick) {
  app::Run(state, "map-read");
  ClickDepth(state, {80, 40});
  ASSERT_TRUE(board().read);
  EXPECT_EQ(WordsAt(*board().read), "30.0 ± 0.2 mm from the portal, measured");
  EXPECT_EQ(WordsAt({15, 40}), "40.0 ± 2.0 mm from the portal, estimated from brightness");
  EXPECT_EQ(WordsAt({28, 75}), "40.0 ± 1.0 mm from the portal, interpolated");
  EXPECT_EQ(WordsAt({3, 3}), "No depth is known here.");
  // erf(1 / (0.2 √2)) is one to 6e-7; a standard error of 1 mm gives 68 %.
  EXPECT_NEAR(ShareWithinOneMm(1e-3), 0.6827, 1e-4);
  EXPECT_TRUE(std::isnan(ShareWithinOneMm(std::nan(""))));
}

TEST_F(DepthMapBoard, SaysOfADepthFromBrightnessThatItIsNotMeasured) {
  authoring::Document document = test::MeasuredDocument();
  document.is_depth_imported = false;
  document.depth_origin = nullptr;
  document.depth_sigma = nullptr;
  const authoring::ReliefReading reading = authoring::ReadRelief(ReliefViewOf(document), {80, 40});
  EXPECT_EQ(WordsOfReading(document, reading), "30.0 mm from the portal, estimated, not measured");
  EXPECT_FALSE(HasMeasuredDepth(document));
}

TEST_F(DepthMapBoard, ALengthScalesRadiusReliefAndUncertaintyInOneStepThatIsUndone) {
  const double before = Distance({60, 20}, {100, 60});
  GiveLength(LengthKind::kTissue, 11);
  ASSERT_TRUE(state.dialogs.empty()) << TakeRefusal();
  const double factor = 0.011 / before;
  EXPECT_NEAR(Distance({60, 20}, {100, 60}), 0.011, 1e-7);
  EXPECT_NEAR(state.document().scene.backdrop.radius, test::kMeasuredRadius * factor, 1e-9);
  EXPECT_NEAR(state.document().depth_sigma->at(80, 40), 2e-4 * factor, 1e-9);
  EXPECT_NE(state.message.find("was 40.0 mm and is"), std::string::npos) << state.message;
  EXPECT_EQ(state.history.UndoName(), "Set the scale by 11 mm");
  app::Run(state, "undo");
  EXPECT_EQ(state.document().scene.backdrop.radius, test::kMeasuredRadius);
  EXPECT_NEAR(Distance({60, 20}, {100, 60}), before, 1e-12);
  EXPECT_FALSE(state.history.CanUndo());
}

TEST_F(DepthMapBoard, ASecondLengthMustAgreeWithinTenPercent) {
  GiveLength(LengthKind::kTissue, 20);
  ASSERT_TRUE(state.dialogs.empty()) << TakeRefusal();
  const double radius = state.document().scene.backdrop.radius;
  GiveLength(LengthKind::kInstrument, 24);
  EXPECT_NE(TakeRefusal().find("disagree by 20 %"), std::string::npos);
  EXPECT_EQ(state.document().scene.backdrop.radius, radius) << "nothing changed";
  GiveLength(LengthKind::kInstrument, 21);
  ASSERT_TRUE(state.dialogs.empty()) << TakeRefusal();
  // Both count alike, so the scale lies half-way.
  EXPECT_NEAR(state.document().scene.backdrop.radius / radius, std::sqrt(21.0 / 20), 1e-4);
  app::Run(state, "forget-lengths");
  EXPECT_FALSE(board().tissue.is_given);
  GiveLength(LengthKind::kInstrument, 40);
  EXPECT_TRUE(state.dialogs.empty()) << "no other length is left: " << TakeRefusal();
}

TEST_F(DepthMapBoard, RefusesALengthOverAPartThatWasNotMeasured) {
  app::Run(state, "map-length");
  ClickDepth(state, {15, 60});
  ClickDepth(state, {100, 60});
  app::Run(state, "set-scale");
  EXPECT_NE(TakeRefusal().find("nothing was measured at the first point"), std::string::npos);
  EXPECT_FALSE(state.history.CanUndo());
}

TEST_F(DepthMapBoard, ScalesNoDepthThatIsEstimated) {
  authoring::Document document = test::MeasuredDocument();
  document.is_depth_imported = false;
  EditorState estimated = MakeEditorState(std::move(document));
  app::Run(estimated, "map-length");
  ClickDepth(estimated, {60, 20});
  ClickDepth(estimated, {100, 60});
  ASSERT_TRUE(estimated.steps.depth->board.length().points.is_complete());
  EXPECT_FALSE(CanSetScale(estimated));
}

TEST_F(DepthMapBoard, AMaskMarksCellsAsInterpolatedAndIsUndone) {
  app::Run(state, "map-brush");
  board().brush.stroke.kind = authoring::StrokeKind::kMask;
  SetBrushRadius(state, 22);
  ClickDepth(state, {78, 40});
  PaintDepth(state, {82, 40});
  EXPECT_FALSE(state.history.CanUndo()) << "not before the brush is let go";
  EndStroke(state);
  EXPECT_EQ(state.history.UndoName(), "Mend depth: Mask");
  EXPECT_EQ(state.document().depth_origin->at(80, 40), ReliefOrigin::kInterpolated);
  EXPECT_EQ(state.document().depth_origin->at(110, 40), ReliefOrigin::kMeasured);
  // The bump of 10 mm is gone: its foot at the brush's edge is 10 mm · exp(-(22/16)²) = 1.5 mm.
  EXPECT_LT(state.document().depth->at(80, 40), 2e-3f);
  EXPECT_GT(state.document().depth_sigma->at(80, 40), 1e-3f);
  app::Run(state, "undo");
  EXPECT_NEAR(state.document().depth->at(80, 40), 0.01, 1e-6);
  EndStroke(state);
  EXPECT_FALSE(state.history.CanUndo()) << "no stroke, no step";
}

TEST_F(DepthMapBoard, KeepsScaleAndMarksInTheSavedScene) {
  const test::TempFolder temp;
  GiveLength(LengthKind::kTissue, 20);
  app::Run(state, "map-brush");
  ClickDepth(state, {80, 40});
  EndStroke(state);
  authoring::SaveDocument(state.document(), temp / "scene");
  const authoring::Document saved = authoring::OpenDocument(temp / "scene");
  EXPECT_TRUE(saved.is_depth_imported);
  EXPECT_NEAR(saved.scene.backdrop.radius, state.document().scene.backdrop.radius, 1e-12);
  ASSERT_TRUE(saved.depth_origin);
  EXPECT_EQ(saved.depth_origin->origin, state.document().depth_origin->origin);
  EXPECT_EQ(saved.depth_sigma->at(80, 40), state.document().depth_sigma->at(80, 40));
}

TEST_F(DepthMapBoard, ColoursEachOriginAndNamesItsShare) {
  const DrawnLayer layer = DrawLayer(state.document(), MapLayer::kOrigin);
  EXPECT_EQ(layer.picture.width, test::kMeasuredWidth);
  ASSERT_EQ(layer.legend.entries.size(), 4u);
  EXPECT_EQ(layer.legend.entries[0].words, "measured, 74 %");
  EXPECT_EQ(layer.legend.entries[3].words, "no depth");
  const auto differ = [&](int x, int y) {
    const std::uint8_t *a = layer.picture.at(x, y), *b = state.document().panorama->at(x, y);
    return a[0] != b[0] || a[1] != b[1] || a[2] != b[2];
  };
  EXPECT_TRUE(differ(90, 40));
  const DrawnLayer bare = DrawLayer(state.document(), MapLayer::kPicture);
  EXPECT_EQ(bare.picture.rgb, state.document().panorama->rgb);
  EXPECT_TRUE(bare.legend.entries.empty());
  const DrawnLayer sigma = DrawLayer(state.document(), MapLayer::kSigma);
  EXPECT_EQ(sigma.legend.high, "2 mm and more");
  const DrawnLayer range = DrawLayer(state.document(), MapLayer::kRange);
  EXPECT_EQ(range.legend.high, "40 mm");
}

TEST_F(DepthMapBoard, DropsItsPointsWithThePanorama) {
  app::Run(state, "map-read");
  KeepDepthBoardFresh(state);
  ASSERT_TRUE(board().drawn.picture);
  ClickDepth(state, {80, 40});
  KeepDepthBoardFresh(state);
  EXPECT_TRUE(board().read);
  app::Run(state, "map-profile");
  ClickDepth(state, {20, 40});
  ClickDepth(state, {100, 40});
  EXPECT_TRUE(board().profile.is_complete());
  ClickDepth(state, {30, 40});
  EXPECT_FALSE(board().profile.is_complete()) << "the third point begins another line";
  authoring::Document other = state.document();
  other.panorama = std::make_shared<const ColourImage>(*other.panorama);
  state.history.Push(other, "another picture");
  KeepDepthBoardFresh(state);
  EXPECT_FALSE(board().read);
  EXPECT_FALSE(board().profile.from);
}

}  // namespace
}  // namespace arthro::app
