// Long sessions of random commands: undo, redo and undo again give the same scenes, byte by byte.
#include <cstdlib>
#include <fstream>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/state/edits.h"
#include "app/steps/depth/depth_brush.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/lessons/exercise_edit.h"
#include "app/steps/panorama/adjust_board.h"
#include "app/steps/panorama/panorama_step.h"
#include "app/steps/portals/portals_step.h"
#include "app/steps/solids/solid_edit.h"
#include "app/steps/tissue/cut/tissue_cut.h"
#include "app/steps/tissue/landmark_mode.h"
#include "app/steps/tissue/library/tissue_library.h"
#include "app/steps/tissue/tissue_balls.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/project/document_io.h"
#include "authoring/project/sharing.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/fingerprint.h"
#include "simulation/scene/files/scene_files.h"
#include "simulation/scene/json/scene_json.h"
#include "simulation/scene/solids/solid_io.h"
#include "tests/app/commands/settle.h"
#include "tests/support/build_paths.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

template <class Part>
std::string MarkOf(const std::vector<Part>& part) {
  return FingerprintOf({reinterpret_cast<const char*>(part.data()), part.size() * sizeof(Part)});
}

// Everything that a save of the document would write.
std::string BytesOf(const authoring::Document& document) {
  std::string text = PrettyJson(JsonFromScene(document.scene));
  authoring::DepthOptions options = document.depth_options;
  options.Visit([&](const char* name, auto& field, const auto&, const char*, const char*) {
    text += name + std::string(" ") + std::to_string(static_cast<double>(field)) + "\n";
  });
  text += document.panorama ? MarkOf(document.panorama->rgb) : "no panorama";
  text += document.depth ? MarkOf(document.depth->relief) : "no depth";
  if (document.depth_sigma) text += MarkOf(document.depth_sigma->relief);
  if (document.depth_origin) text += MarkOf(document.depth_origin->origin);
  if (document.depth_strokes)
    for (const authoring::DepthStroke& stroke : *document.depth_strokes)
      text += MarkOf(stroke.points) + std::to_string(static_cast<int>(stroke.kind)) + " ";
  for (const auto& surface : document.surfaces)
    text += MarkOf(surface->vertices) + MarkOf(surface->triangles);
  for (const Tissue& tissue : document.scene.tissues) {
    if (!tissue.mesh.empty()) text += FingerprintOf(ReadWholeFile(FileOf(document, tissue.mesh)));
    if (IsSolidFile(tissue.surface))
      text += FingerprintOf(ReadWholeFile(FileOf(document, tissue.surface)));
  }
  if (document.lens) text += std::to_string(document.lens->focal_px);
  return text + (document.is_depth_imported ? " imported" : " made") + document.folder.string();
}

// ARTHRO_SESSION_SEED gives another session.
class RandomSession : public testing::Test {
 protected:
  RandomSession() {
    test::WriteSmallScene(temp / "knee");
    StartDocument(state, authoring::OpenDocument(temp / "knee"), true, NoteOnDisk(temp / "knee"));
    state.steps.tissue->preset_folder = fs::path(ARTHRO_SOURCE_DIR) / "resources/presets/tissues";
    LoadTissuePresets(state);
    state.steps.tissue->mesh_size = authoring::MeshSize::kCoarse;
    const std::set<std::string> found = AddCommands();
    for (const char* id : kCommands)
      if (!found.contains(id)) ADD_FAILURE() << "no command " << id;
  }
  // Commands that change the scene, or the page from which it is changed: not those that ask for a
  // file, leave the scene or begin a practice. Ids that end in '-' stand for all that begin so.
  static constexpr const char* kCommands[] = {"step-",
                                              "view-",
                                              "offer-",
                                              "map-",
                                              "mirror-",
                                              "add-",
                                              "remove-",
                                              "nudge-",
                                              "turn-",
                                              "part-",
                                              "brush-",
                                              "cut-",
                                              "hold-",
                                              "probe-",
                                              "release-",
                                              "set-scale",
                                              "forget-lengths",
                                              "make-depth",
                                              "depth-map",
                                              "depth-scope",
                                              "touch-preview",
                                              "tetrahedralise",
                                              "mend-surface",
                                              "make-layer",
                                              "duplicate-tissue",
                                              "library",
                                              "make-tear",
                                              "landmarks",
                                              "leave-landmarks",
                                              "align-landmarks",
                                              "fit-to-relief",
                                              "pick-patch",
                                              "lay-on-relief",
                                              "show-before",
                                              "tissue-before-scope",
                                              "new-exercise",
                                              "copy-exercise",
                                              "measure-relief",
                                              "leave-depth-brush"};
  std::set<std::string> AddCommands() {
    std::set<std::string> found;
    for (const Command& command : AllCommands()) {
      const std::string id = command.id;
      for (const std::string entry : kCommands)
        if (entry.ends_with('-') ? id.starts_with(entry) : id == entry) {
          commands.push_back(&command);
          found.insert(entry);
        }
    }
    return found;
  }
  void Settle() { app::Settle(state); }
  int Pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random); }
  double Share() { return std::uniform_real_distribution<double>(0, 1)(random); }
  int TissueCount() const { return static_cast<int>(state.document().scene.tissues.size()); }

  void EditByMouse() {
    state.tissue = TissueCount() > 0 ? Pick(TissueCount()) : -1;
    const glm::dvec3 place(0.006 * Share(), 0.006 * Share(), 0.006 * Share());
    switch (Pick(23)) {
      case 0:
        return SetTitle(state, "title " + std::to_string(Pick(1000)));
      case 1:
        for (int i = 0; i < 5; ++i) SetIncisionSpacing(state, 0.01 + 0.03 * Share());
        return EndDrag(state);
      case 2:
        return SetFieldOfView(state, 0.8 + Share());
      case 3:
        return SetRelight(state, Share());
      case 4:
        return SetRodLength(state, 0.15 + 0.1 * Share());
      case 5:
        return SetViewAngle(state, Pick(2) == 0 ? 0.5 : 1.2);
      case 6: {
        if (state.tissue < 0) return;
        Tissue moved = state.document().scene.tissues[static_cast<std::size_t>(state.tissue)];
        for (int i = 0; i < 4; ++i) {
          moved.pose.position.x += 1e-3 * Share();
          SetTissue(state, state.tissue, moved, "Place");
        }
        return EndDrag(state);
      }
      case 7:
        if (TissueCount() < 4) DuplicateTissue(state, state.tissue);
        return;
      case 8:
        if (TissueCount() > 1) RemoveTissue(state, state.tissue);
        return;
      case 9:
        if (state.tissue >= 0) AddBall(state, BallKind::kHeld, state.tissue, place);
        return;
      case 10:
        if (state.tissue >= 0) AddBall(state, BallKind::kProbed, state.tissue, place);
        return;
      case 11:
        state.steps.tissue->cut_brush.kind =
            Pick(2) == 0 ? CutBrush::Kind::kBite : CutBrush::Kind::kRegion;
        if (state.tissue >= 0) UseCutBrush(state, state.tissue, place);
        return;
      case 12: {
        authoring::DepthOptions options = state.document().depth_options;
        options.gamma = 0.5 + Share();
        return SetDepthOptions(state, options, "Gamma");
      }
      case 13:
        return SetSide(state, static_cast<BodySide>(Pick(3)));
      case 14: {
        const auto assets = AssetsOf(state.document());
        const authoring::Asset& asset = assets[static_cast<std::size_t>(Pick(int(assets.size())))];
        return SetRights(state, asset, {"source " + std::to_string(Pick(100)), "CC0-1.0", "none"},
                         "rights");
      }
      case 15:
        return Paint();
      case 16:
        return PlaceLandmark();
      case 17:
        return Adjust();
      case 18:
        if (TissueCount() < kMostTissues)
          DropLibraryModel(state, static_cast<authoring::ModelKind>(Pick(10)),
                           authoring::SightOfPanorama(state.document().scene.backdrop, Pixel()));
        return;
      case 19:
        return ChangeSolid();
      case 20:
        if (HasExercise(state))
          EditExercise(state, "Rename", "", [&](Exercise& exercise) {
            exercise.title = "exercise " + std::to_string(Pick(1000));
          });
        return;
      case 21:
        if (state.tissue >= 0)
          ChoosePreset(state, state.tissue, Pick(2) == 0 ? "cartilage" : "meniscus");
        return;
      default: {
        Backdrop backdrop = state.document().scene.backdrop;
        backdrop.radius = 0.04 + 0.02 * Share();
        return SetBackdrop(state, backdrop, "the radius");
      }
    }
  }

  glm::dvec2 Pixel() {
    const auto& panorama = *state.document().panorama;
    return {Share() * (panorama.width - 1), Share() * (panorama.height - 1)};
  }

  void Paint() {
    app::Run(state, "step-depth");
    app::Run(state, "depth-map");
    app::Run(state, "map-brush");
    if (!PaintsDepth(state)) return;
    state.steps.depth->board.brush.stroke.kind = static_cast<authoring::StrokeKind>(Pick(6));
    SetBrushRadius(state, 5 + 10 * Share());
    PaintDepth(state, Pixel());
    if (Pick(4) == 0) return CancelStroke(state);
    PaintDepth(state, Pixel());
    EndStroke(state);
    painted += 1;
  }

  void PlaceLandmark() {
    if (state.tissue < 0) return;
    state.step = Step::kTissue;
    if (!PlacesLandmarks(state)) ToggleLandmarks(state);
    if (!PlacesLandmarks(state)) return;
    const auto& surface = state.document().surfaces[static_cast<std::size_t>(state.tissue)];
    const auto& vertices = surface->vertices;
    TakeModelPoint(state, state.tissue,
                   vertices[static_cast<std::size_t>(Pick(int(vertices.size())))]);
    TakeScenePoint(state, authoring::SightOfPanorama(state.document().scene.backdrop, Pixel()));
    if (HasChosenLandmark(state) && Pick(3) == 0) LeaveOutLandmark(state, 0, true);
  }

  void Adjust() {
    constexpr int kLeastWidth = 120;  // px; what is smaller is not cropped further
    AdjustBoard& board = state.steps.panorama->adjust;
    const AdjustTool tools[] = {AdjustTool::kCrop, AdjustTool::kLength, AdjustTool::kUp,
                                AdjustTool::kMedial};
    const AdjustTool tool = tools[Pick(4)];
    const glm::dvec2 size(state.document().panorama->width, state.document().panorama->height);
    if (tool == AdjustTool::kCrop && size.x < kLeastWidth) return;
    state.step = Step::kPanorama;
    if (board.tool != tool) SetAdjustTool(state, tool);
    board.from = tool == AdjustTool::kCrop ? 0.04 * size : 0.4 * size;
    board.to = tool == AdjustTool::kCrop ? 0.97 * size : Pixel();
    board.millimetres = 5 + 10 * Share();
    Guarded(state, "Change the backdrop", [&] { ApplyAdjustment(state); });
  }

  void ChangeSolid() {
    if (state.tissue < 0 || !IsSolidChosen(state)) {
      if (TissueCount() < kMostTissues) AddSolid(state);
      return;
    }
    const Solid* solid = ChosenSolid(state);
    if (solid == nullptr) return;
    state.steps.tissue->solids->part = Pick(static_cast<int>(solid->parts.size()));
    SolidPart part = solid->parts[static_cast<std::size_t>(state.steps.tissue->solids->part)];
    PlaceOf(part).blend = 1e-3 * Share();
    if (auto* ellipsoid = std::get_if<EllipsoidPart>(&part))
      ellipsoid->radii = glm::dvec3(2e-3 + 3e-3 * Share());
    SetSolidPart(state, part, "Resize");
    EndDrag(state);
  }

  // Models and copies beyond this number would make the session slow.
  static constexpr int kMostTissues = 5;
  bool IsTooMuch(const std::string& id) const {
    return TissueCount() >= kMostTissues && (id.starts_with("add-") || id == "duplicate-tissue");
  }

  void DoSomething() {
    KeepLandmarksFresh(state);  // each frame does it
    if (Pick(3) > 0) {
      EditByMouse();
    } else {
      const Command& command = *commands[static_cast<std::size_t>(Pick(int(commands.size())))];
      if (IsTooMuch(command.id)) return;
      const long long before = state.history.StateId();
      app::Run(state, command);
      if (state.history.StateId() != before) used.insert(command.id);
    }
    state.dialogs.clear();
    if (state.jobs.busy() || Pick(20) == 0) Settle();
    if (Pick(10) == 0) app::Run(state, "undo");
  }

  // Scenes of every step, from the newest back to the oldest, or the other way.
  std::vector<std::string> Walk(const char* command) {
    std::vector<std::string> scenes = {BytesOf(state.document())};
    while (CommandOf(state, command).enabled(state)) {
      app::Run(state, command);
      scenes.push_back(BytesOf(state.document()));
    }
    return scenes;
  }

  test::TempFolder temp;
  static unsigned Seed() {
    const char* const given = std::getenv("ARTHRO_SESSION_SEED");
    return given != nullptr ? static_cast<unsigned>(std::atoi(given)) : 7;
  }
  std::mt19937 random{Seed()};
  EditorState state = MakeEditorState(NewDocument());
  std::vector<const Command*> commands;
  std::set<std::string> used;
  int painted = 0;
};

TEST_F(RandomSession, AThousandRandomCommandsAreUndoneRedoneAndUndoneToTheSameBytes) {
  for (int i = 0; i < 1000; ++i) DoSomething();
  Settle();
  Walk("redo");
  const std::vector<std::string> undone = Walk("undo");
  EXPECT_GT(undone.size(), 300u) << "most commands are steps";
  EXPECT_GE(used.size(), 15u) << "commands that are edits";
  EXPECT_GT(painted, 0);
  std::vector<std::string> redone = Walk("redo");
  std::reverse(redone.begin(), redone.end());
  EXPECT_TRUE(redone == undone);
  EXPECT_TRUE(Walk("undo") == undone);
  RecordProperty("steps", static_cast<int>(undone.size()));
  EXPECT_GT(std::set<std::string>(undone.begin(), undone.end()).size(), 250u);
}

}  // namespace
}  // namespace arthro::app
