#include "authoring/project/history.h"

#include <functional>

#include <gtest/gtest.h>

#include "simulation/scene/json/scene_json.h"

namespace arthro::authoring {
namespace {

Document SmallDocument() {
  Document document;
  document.scene.title = "start";
  document.scene.backdrop.panorama = "p.png";
  document.panorama = std::make_shared<ColourImage>(100, 50);
  document.depth = std::make_shared<DepthMap>(100, 50);
  return document;
}

// Everything of a document as text; big parts by identity, which sharing makes exact.
std::string Print(const Document& document) {
  std::string text = PrettyJson(JsonFromScene(document.scene));
  Document copy = document;
  copy.depth_options.Visit(
      [&](const char* name, auto& field, const auto&, const char*, const char*) {
        text += name + std::string(" ") + std::to_string(static_cast<double>(field)) + "\n";
      });
  const auto put = [&](const void* part) { text += std::to_string(std::size_t(part)) + "\n"; };
  put(document.panorama.get());
  put(document.depth.get());
  put(document.depth_sigma.get());
  put(document.depth_origin.get());
  for (const auto& surface : document.surfaces) put(surface.get());
  for (const auto& [name, file] : document.files) text += name + " " + file.file.string() + "\n";
  return text + document.folder.string();
}

struct Edit {
  const char* name;
  std::function<void(Document&)> apply;
};

std::vector<Edit> EveryKindOfEdit() {
  return {{"title", [](Document& d) { d.scene.title = "other"; }},
          {"projection", [](Document& d) { d.scene.backdrop.projection.focal_px = 77; }},
          {"spacing", [](Document& d) { d.scene.portals.incision_spacing = -0.02; }},
          {"scope", [](Document& d) { d.scene.scope.view_angle = 1.2; }},
          {"rig", [](Document& d) { d.scene.rig.instrument.pivot.x = 0.01; }},
          {"depth option", [](Document& d) { d.depth_options.gamma = 1.5; }},
          {"depth", [](Document& d) { d.depth = std::make_shared<DepthMap>(100, 50, 0.01f); }},
          {"error of the depth", [](Document& d) { d.depth_sigma = Share(DepthMap(100, 50)); }},
          {"origins of the depth", [](Document& d) { d.depth_origin = Share(OriginMap(100, 50)); }},
          {"panorama", [](Document& d) { d.panorama = std::make_shared<ColourImage>(10, 5); }},
          {"add tissue",
           [](Document& d) {
             d.scene.tissues.emplace_back().name = "meniscus";
             d.surfaces.push_back(std::make_shared<SurfaceMesh>());
             d.files["m.vtu"].file = "/a/m.vtu";
           }},
          {"move tissue", [](Document& d) { d.scene.tissues[0].pose.position.z = 0.03; }},
          {"remove tissue",
           [](Document& d) {
             d.scene.tissues.clear();
             d.surfaces.clear();
           }},
          {"task", [](Document& d) { d.scene.exercises.emplace_back().id = "look"; }}};
}

TEST(History, UndoAndRedoOfEveryEditRestoreEveryValue) {
  History history(SmallDocument());
  std::vector<std::string> states = {Print(history.current())};
  for (const Edit& edit : EveryKindOfEdit()) {
    Document next = history.current();
    edit.apply(next);
    history.Push(next, edit.name);
    states.push_back(Print(history.current()));
    ASSERT_NE(states.back(), states[states.size() - 2]) << edit.name << " changed nothing";
  }
  const auto edits = EveryKindOfEdit();
  for (std::size_t i = states.size() - 1; i > 0; --i) {
    EXPECT_EQ(history.UndoName(), edits[i - 1].name);
    history.Undo();
    EXPECT_EQ(Print(history.current()), states[i - 1]);
  }
  EXPECT_FALSE(history.CanUndo());
  history.Undo();
  EXPECT_EQ(Print(history.current()), states[0]);
  for (std::size_t i = 1; i < states.size(); ++i) {
    EXPECT_EQ(history.RedoName(), edits[i - 1].name);
    history.Redo();
    EXPECT_EQ(Print(history.current()), states[i]);
  }
  EXPECT_FALSE(history.CanRedo());
  history.GoTo(3);
  EXPECT_EQ(Print(history.current()), states[3]);
  EXPECT_EQ(history.StepNames().size(), states.size());
}

void PushTitle(History& history, const std::string& title, const std::string& merge_key = "") {
  Document next = history.current();
  next.scene.title = title;
  history.Push(next, "Set title to " + title, merge_key);
}

TEST(History, AnEditAfterUndoForgetsWhatWasUndone) {
  History history(SmallDocument());
  PushTitle(history, "a");
  PushTitle(history, "b");
  history.Undo();
  PushTitle(history, "c");
  EXPECT_FALSE(history.CanRedo());
  history.Undo();
  EXPECT_EQ(history.current().scene.title, "a");
}

TEST(History, OneDragIsOneStepAndTheNextDragAnother) {
  History history(SmallDocument());
  for (const char* title : {"a", "b", "c"}) PushTitle(history, title, "title");
  history.EndMerge();
  for (const char* title : {"d", "e"}) PushTitle(history, title, "title");
  PushTitle(history, "f", "another slider");
  EXPECT_EQ(history.StepNames().size(), 4u);
  history.Undo();
  EXPECT_EQ(history.current().scene.title, "e");
  history.Undo();
  EXPECT_EQ(history.current().scene.title, "c");
  PushTitle(history, "g", "title");  // undo ended the drag
  history.Undo();
  EXPECT_EQ(history.current().scene.title, "c");
  history.Undo();
  EXPECT_EQ(history.current().scene.title, "start");
}

TEST(History, IsSavedFollowsUndoAndRedo) {
  History history(SmallDocument());
  EXPECT_FALSE(history.IsSaved());
  history.MarkSaved();
  EXPECT_TRUE(history.IsSaved());
  PushTitle(history, "a", "title");
  EXPECT_FALSE(history.IsSaved());
  history.MarkSaved();
  PushTitle(history, "b", "title");  // a drag that goes on after saving
  EXPECT_FALSE(history.IsSaved());
  history.Undo();
  EXPECT_TRUE(history.IsSaved());
  EXPECT_EQ(history.current().scene.title, "a");
  history.Undo();
  EXPECT_FALSE(history.IsSaved());
  PushTitle(history, "c");  // the saved state can no longer be reached
  EXPECT_FALSE(history.IsSaved());
  history.Undo();
  EXPECT_FALSE(history.IsSaved());
}

TEST(History, SharedPartsAreCountedOnceAndTheOldestStepsGoFirst) {
  constexpr std::size_t kPanorama = 100 * 50 * 3, kDepth = 100 * 50 * 4;
  History history(SmallDocument(), kPanorama + 3 * kDepth);
  for (int i = 0; i < 100; ++i) PushTitle(history, std::to_string(i));
  EXPECT_EQ(history.MemoryUsed(), kPanorama + kDepth);
  EXPECT_EQ(history.StepNames().size(), 101u);
  for (int i = 0; i < 10; ++i) {
    Document next = history.current();
    next.depth = std::make_shared<DepthMap>(100, 50, static_cast<float>(i));
    history.Push(next, "Depth " + std::to_string(i));
    EXPECT_LE(history.MemoryUsed(), kPanorama + 3 * kDepth);
  }
  EXPECT_EQ(history.StepNames(), (std::vector<std::string>{"Depth 7", "Depth 8", "Depth 9"}));
  EXPECT_EQ(history.current().depth->at(0, 0), 9.0f);
}

TEST(History, TheLastEditCanBeUndoneEvenUnderAVanishingLimit) {
  History history(SmallDocument(), 0);
  Document next = history.current();
  next.depth = std::make_shared<DepthMap>(100, 50, 1.0f);
  history.Push(next, "Depth");
  history.Undo();
  EXPECT_EQ(history.current().depth->at(0, 0), 0.0f);
}

TEST(History, AProductOfAnEditIsUndoneWithIt) {
  History history(SmallDocument());
  const std::string before = Print(history.current());
  Document edited = history.current();
  edited.depth_options.gamma = 1.5;
  history.Push(edited, "Depth: gamma", "depth.gamma");
  history.MarkSaved();
  edited.depth = std::make_shared<DepthMap>(100, 50, 0.01f);
  history.Amend(edited);
  EXPECT_FALSE(history.IsSaved()) << "what is on disk lacks the product";
  EXPECT_EQ(history.UndoName(), "Depth: gamma");
  history.Undo();
  EXPECT_EQ(Print(history.current()), before);
  history.Redo();
  EXPECT_EQ(history.current().depth, edited.depth);
}

}  // namespace
}  // namespace arthro::authoring
