// Models of the library and kinds of tears, without a window.
#include "app/steps/tissue/library/tissue_library.h"

#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "tests/support/plain_document.h"

namespace arthro::app {
namespace {

class TissueLibrary : public testing::Test {
 protected:
  TissueLibrary() { state.reset(new EditorState(MakeEditorState(test::PlainDocument()))); }
  void Finish() {
    while (state->jobs.busy())
      if (!state->jobs.Finish(*state)) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  const std::vector<Tissue>& Tissues() const { return state->document().scene.tissues; }
  std::unique_ptr<EditorState> state;
};

TEST_F(TissueLibrary, AModelIsAddedOnTheReliefByOneStep) {
  app::Run(*state, "add-loose-body");
  Finish();
  ASSERT_EQ(Tissues().size(), 1u);
  EXPECT_EQ(Tissues()[0].name, "loose body");
  EXPECT_TRUE(Tissues()[0].is_implicit);
  EXPECT_EQ(state->tissue, 0);
  EXPECT_GT(glm::length(Tissues()[0].pose.position), 0.03) << "on the relief, not before it";
  app::Run(*state, "undo");
  EXPECT_TRUE(Tissues().empty());
  EXPECT_FALSE(state->history.CanUndo());
  app::Run(*state, "redo");
  EXPECT_EQ(Tissues().size(), 1u);
}

TEST_F(TissueLibrary, AModelIsMadeForTheSideOfTheScene) {
  const auto middle_of = [&](BodySide side) {
    state.reset(new EditorState(MakeEditorState(test::PlainDocument())));
    SetSide(*state, side);
    app::Run(*state, "add-loose-body");
    Finish();
    glm::dvec3 sum{0.0};
    for (const glm::dvec3& x : state->document().surfaces.at(0)->vertices) sum += x * x * x;
    return sum;
  };
  const double right = middle_of(BodySide::kRight).x;
  ASSERT_GT(std::abs(right), 0) << "no mirror image of itself";
  EXPECT_NEAR(middle_of(BodySide::kLeft).x, -right, 1e-6 * std::abs(right));
}

TEST_F(TissueLibrary, ATearIsMadeByOneStep) {
  authoring::Document document = state->document();
  const auto model =
      authoring::MakeModel(authoring::DefaultOptionsOf(authoring::ModelKind::kMedialMeniscus),
                           authoring::KneeSide::kRight);
  document.scene.tissues.push_back(authoring::TissueOf(model));
  document.scene.tissues[0].mesh = "tissues/m.vtu";
  document.surfaces.push_back(Share(model.surface));
  state.reset(new EditorState(MakeEditorState(std::move(document))));
  state->tissue = 0;
  ChooseTear(*state, authoring::TearKind::kHorizontal);
  UpdateTearPreview(*state);
  EXPECT_TRUE(state->steps.tissue->shelf->preview_fault.empty());
  EXPECT_FALSE(state->steps.tissue->shelf->preview->tears.empty());
  EXPECT_TRUE(Tissues()[0].cuts.empty()) << "a preview changes nothing";
  app::Run(*state, "make-tear");
  EXPECT_GT(Tissues()[0].cuts.size(), 3u);
  app::Run(*state, "undo");
  EXPECT_TRUE(Tissues()[0].cuts.empty());

  state->steps.tissue->shelf->tear.length = 0.08;
  state->steps.tissue->shelf->preview.reset();
  UpdateTearPreview(*state);
  EXPECT_NE(state->steps.tissue->shelf->preview_fault.find("shorten"), std::string::npos)
      << state->steps.tissue->shelf->preview_fault;
}

}  // namespace
}  // namespace arthro::app
