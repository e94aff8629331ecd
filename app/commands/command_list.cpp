#include "app/commands/command_list.h"

#include <algorithm>
#include <stdexcept>

#include <GLFW/glfw3.h>

#include "app/commands/depth_work.h"
#include "app/commands/edits.h"
#include "app/commands/footage/footage_work.h"
#include "app/commands/scene_files.h"
#include "app/commands/tissue/tissue_balls.h"
#include "app/commands/tissue/tissue_cut.h"
#include "app/commands/tissue/tissue_poke.h"
#include "app/commands/tissue_work.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

using State = EditorState;

bool Always(const State&) { return true; }
bool InEditor(const State& state) { return !state.practice && !state.practice_only; }
bool Idle(const State& state) { return InEditor(state) && !state.jobs.busy(); }
bool HasPicture(const State& state) {
  return InEditor(state) && state.document().panorama != nullptr;
}
bool ShowsScope(const State& state) { return !ShowsFootage(state); }
bool HasTissue(const State& state) {
  return Idle(state) && ShowsScope(state) && state.tissue >= 0 &&
         state.tissue < static_cast<int>(state.document().scene.tissues.size());
}
bool Practising(const State& state) { return state.practice.has_value(); }

template <BallKind kind>
void ToggleBrush(State& state) {
  if (state.brush == kind)
    state.brush.reset();
  else
    state.brush = kind;
  state.message = !state.brush ? "The overview turns and moves again."
                  : kind == BallKind::kHeld
                      ? "Click on the tissue in the overview to hold it there."
                      : "Click on the tissue in the overview where its mesh shall be finer.";
}

void StartPractice(State& state) {
  WhenDepthIsReady(state, [](State& ready) {
    ready.jobs.Start("Practise", [document = ready.document(), presets = ready.tissue_presets,
                                  pace = ready.pace](const Progress&) {
      const auto practice = std::make_shared<Practice>(document, presets, pace);
      return [practice](State& now) {  // shared only because a std::function is copied
        now.practice.emplace(std::move(*practice));
        now.message = "Practice. Esc leaves it.";
      };
    });
  });
}

void LeavePractice(State& state) {
  const double seconds = state.practice->snapshot().t;
  state.practice.reset();
  state.full_screen = false;
  state.message = "Practice left.";
  if (state.practice_only) state.dialogs.push_back(PracticeEndedDialog{seconds});
}

void Quit(State& state) {
  GuardUnsaved(state, "quit", [](State& sure) { sure.quit = true; });
}

void ResetHands(State& state) {
  if (state.practice) {
    state.practice->scope().Set(StartOfScope(state.document().scene));
    state.practice->instrument().Set(StartOfInstrument(state.document().scene));
  }
  state.scope = StartOfScope(state.document().scene);
  state.instrument = StartOfInstrument(state.document().scene);
  state.message = "Both hands are back where they began.";
}

template <int degrees>
void LookAt(State& state) {
  SetViewAngle(state, RadiansFromDegrees(degrees));
  state.message = "View angle " + std::to_string(degrees) + "°";
}

template <simulation::ToolKind kind>
void TakeInstrument(State& state) {
  state.practice->SetInstrument(kind);
}

template <Step step>
void Open(State& state) {
  state.step = step;
}

const std::vector<FileFilter>& SceneFilters() {
  static const std::vector<FileFilter> filters = {{"Scenes", {".json", ".arthro"}},
                                                  {"All files", {}}};
  return filters;
}

const std::vector<FileFilter>& PictureFilters() {
  static const std::vector<FileFilter> filters = {
      {"Pictures", {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp"}}, {"All files", {}}};
  return filters;
}

constexpr Command kCommands[] = {
    {"new",
     "New",
     "Begin a scene with nothing in it.",
     "Scene",
     {GLFW_KEY_N, true},
     {},
     Idle,
     [](State& state) {
       GuardUnsaved(state, "begin a new scene", [](State& sure) {
         StartDocument(sure, NewDocument(), true);
         sure.step = Step::kPanorama;
         sure.message = "A new scene. Import a panorama, or make one from a video.";
       });
     }},
    {"open",
     "Open…",
     "Open a scene.",
     "Scene",
     {GLFW_KEY_O, true},
     {},
     Idle,
     [](State& state) {
       GuardUnsaved(state, "open another scene", [](State& sure) {
         Browse(sure, BrowseFor::kOpenFile, "Open a scene", "Open", SceneFilters(), OpenScene);
       });
     }},
    {"save",
     "Save",
     "Save the scene where it was opened from.",
     "Scene",
     {GLFW_KEY_S, true},
     {},
     [](const State& state) { return Idle(state) && state.document().panorama != nullptr; },
     [](State& state) { SaveScene(state); }},
    {"save-as",
     "Save as…",
     "Save the scene in another folder.",
     "Scene",
     {GLFW_KEY_S, true, true},
     {},
     [](const State& state) { return Idle(state) && state.document().panorama != nullptr; },
     [](State& state) { SaveSceneAs(state); }},
    {"import-panorama",
     "Import a panorama…",
     "Make a picture the backdrop.",
     "Scene",
     {GLFW_KEY_I, true},
     {},
     Idle,
     [](State& state) {
       Browse(state, BrowseFor::kOpenFile, "Import a panorama", "Import", PictureFilters(),
              ImportPanorama);
     }},
    {"make-panorama",
     "Make one from a video…",
     "Put a panorama together from the frames of a video, or of a folder of pictures.",
     "Scene",
     {GLFW_KEY_M, true},
     {},
     Idle,
     BrowseForFootage},
    {"run-footage",
     "Run",
     "Make the panorama. What was made before is kept until this is done.",
     "Scene",
     {GLFW_KEY_R, true},
     {},
     [](const State& state) { return InEditor(state) && CanRun(state); },
     RunFootage},
    {"use-panorama",
     "Use this panorama",
     "Make it the backdrop of the scene, and go on to its depth.",
     "Scene",
     {},
     {},
     [](const State& state) { return Idle(state) && state.footage && state.footage->made; },
     UseMadePanorama},
    {"read-report",
     "Read its report…",
     "Take the panorama's middle and focal length from the report of `arthroscene panorama`.",
     "Scene",
     {},
     {},
     [](const State& state) { return Idle(state) && HasPicture(state); },
     [](State& state) {
       Browse(state, BrowseFor::kOpenFile, "Read a panorama's report", "Read",
              {{"Reports", {".json"}}, {"All files", {}}}, ReadPanoramaReport);
     }},
    {"quit", "Quit", "Close the window.", "Scene", {GLFW_KEY_Q, true}, {}, Always, Quit},

    {"undo",
     "Undo",
     "Take the last edit back.",
     "Edit",
     {GLFW_KEY_Z, true},
     {},
     [](const State& state) { return InEditor(state) && state.history.CanUndo(); },
     [](State& state) {
       state.message = "Undone: " + state.history.UndoName();
       state.history.Undo();
     }},
    {"redo",
     "Redo",
     "Do again what was taken back.",
     "Edit",
     {GLFW_KEY_Z, true, true},
     {GLFW_KEY_Y, true},
     [](const State& state) { return InEditor(state) && state.history.CanRedo(); },
     [](State& state) {
       state.message = "Done again: " + state.history.RedoName();
       state.history.Redo();
     }},
    {"import-surface",
     "Import a surface…",
     "Add a tissue from an STL, OBJ, PLY, OFF or VTP file.",
     "Edit",
     {},
     {},
     [](const State& state) { return Idle(state) && HasPicture(state); },
     BrowseForSurface},
    {"tetrahedralise",
     "Make tetrahedra",
     "Fill the chosen tissue with tetrahedra.",
     "Edit",
     {},
     {},
     HasTissue,
     TetrahedraliseTissue},
    {"hold-brush",
     "Hold it here…",
     "Click on the tissue in the overview: it is held there, in a ball of the radius above.",
     "Edit",
     {},
     {},
     HasTissue,
     ToggleBrush<BallKind::kHeld>},
    {"hold-at-instrument",
     "Hold it at the instrument",
     "Hold the chosen tissue where the instrument's tip is.",
     "Edit",
     {},
     {},
     HasTissue,
     [](State& state) { AddBallAtInstrument(state, BallKind::kHeld); }},
    {"release-ball",
     "Release this one",
     "Take the chosen ball away.",
     "Edit",
     {},
     {},
     [](const State& state) {
       return HasTissue(state) && state.tissue_page == TissuePage::kHold &&
              HasChosenBall(state, BallKind::kHeld);
     },
     [](State& state) { RemoveChosenBall(state, BallKind::kHeld); }},
    {"release-tissue",
     "Release all",
     "Take all balls away: nothing holds the tissue any more.",
     "Edit",
     {},
     {},
     [](const State& state) { return HasTissue(state) && HasBalls(state, BallKind::kHeld); },
     [](State& state) { RemoveAllBalls(state, BallKind::kHeld); }},
    {"probe-brush",
     "Finer here…",
     "Click on the tissue in the overview: the next tetrahedra are finer there, in a ball of the "
     "radius above.",
     "Edit",
     {},
     {},
     HasTissue,
     ToggleBrush<BallKind::kProbed>},
    {"probe-at-instrument",
     "Finer at the instrument",
     "The next tetrahedra of the chosen tissue are finer where the instrument's tip is.",
     "Edit",
     {},
     {},
     HasTissue,
     [](State& state) { AddBallAtInstrument(state, BallKind::kProbed); }},
    {"remove-probed",
     "Not this one",
     "Take the chosen place away.",
     "Edit",
     {},
     {},
     [](const State& state) {
       return HasTissue(state) && state.tissue_page == TissuePage::kMesh &&
              HasChosenBall(state, BallKind::kProbed);
     },
     [](State& state) { RemoveChosenBall(state, BallKind::kProbed); }},
    {"remove-all-probed",
     "None of them",
     "Take all places away: the next tetrahedra are finer where the tissue is free.",
     "Edit",
     {},
     {},
     [](const State& state) { return HasTissue(state) && HasBalls(state, BallKind::kProbed); },
     [](State& state) { RemoveAllBalls(state, BallKind::kProbed); }},
    {"cut-tear",
     "Tear…",
     "Click points along the tear on the tissue in the overview; press again to end it.",
     "Edit",
     {},
     {},
     HasTissue,
     [](State& state) { ToggleCutBrush(state, CutBrush::Kind::kTear); }},
    {"cut-bite",
     "Bite…",
     "Click on the tissue in the overview: a round bite is taken there.",
     "Edit",
     {},
     {},
     HasTissue,
     [](State& state) { ToggleCutBrush(state, CutBrush::Kind::kBite); }},
    {"remove-cut",
     "Remove this cut",
     "Make the tissue whole where the chosen cut is.",
     "Edit",
     {},
     {},
     [](const State& state) { return HasTissue(state) && ChosenCut(state) != nullptr; },
     RemoveChosenCut},
    {"remove-all-cuts",
     "Remove all cuts",
     "Make the tissue whole.",
     "Edit",
     {},
     {},
     [](const State& state) {
       return HasTissue(state) &&
              !state.document().scene.tissues[static_cast<std::size_t>(state.tissue)].cuts.empty();
     },
     RemoveAllCuts},
    {"cut-region",
     "Region…",
     "Click on the tissue in the overview: what a trainee takes in a ball about it is told by "
     "name.",
     "Edit",
     {},
     {},
     HasTissue,
     [](State& state) { ToggleCutBrush(state, CutBrush::Kind::kRegion); }},
    {"remove-region",
     "Remove this region",
     "What is taken there is told under another name.",
     "Edit",
     {},
     {},
     [](const State& state) { return HasTissue(state) && ChosenRegion(state) != nullptr; },
     RemoveChosenRegion},
    {"poke",
     "Poke it",
     "Let the instrument press on the tissue, here in your own view.",
     "Edit",
     {},
     {},
     [](const State& state) { return Idle(state) && HasPicture(state) && ShowsScope(state); },
     [](State& state) { state.poke ? EndPoke(state) : StartPoke(state); }},
    {"duplicate-tissue",
     "Duplicate",
     "Add a copy of the chosen tissue beside it.",
     "Edit",
     {GLFW_KEY_D, true},
     {},
     HasTissue,
     [](State& state) { DuplicateTissue(state, state.tissue); }},
    {"remove-tissue",
     "Remove",
     "Take the chosen tissue out of the scene.",
     "Edit",
     {GLFW_KEY_DELETE},
     {},
     HasTissue,
     [](State& state) { RemoveTissue(state, state.tissue); }},

    {"step-panorama",
     "Panorama",
     "The picture that is the backdrop.",
     "Steps",
     {GLFW_KEY_F6},
     {},
     InEditor,
     Open<Step::kPanorama>},
    {"step-depth",
     "Depth",
     "How brightness becomes relief.",
     "Steps",
     {GLFW_KEY_F7},
     {},
     InEditor,
     Open<Step::kDepth>},
    {"step-tissue",
     "Tissue",
     "Deformable models in the scene.",
     "Steps",
     {GLFW_KEY_F8},
     {},
     InEditor,
     Open<Step::kTissue>},
    {"step-portals",
     "Portals",
     "Incisions and the scope.",
     "Steps",
     {GLFW_KEY_F9},
     {},
     InEditor,
     Open<Step::kPortals>},
    {"step-practice",
     "Practice",
     "Try the scene as a trainee will.",
     "Steps",
     {GLFW_KEY_F10},
     {},
     InEditor,
     Open<Step::kPractice>},

    {"practise",
     "Practise",
     "Practise in this scene at once.",
     "Practice",
     {GLFW_KEY_F5},
     {GLFW_KEY_P},
     [](const State& state) {
       return !state.practice && !state.jobs.busy() && state.document().panorama;
     },
     StartPractice},
    {"leave-practice",
     "Leave practice",
     "Back to the editor, exactly where it was.",
     "Practice",
     {GLFW_KEY_ESCAPE},
     {},
     Practising,
     LeavePractice},
    {"reset-hands",
     "Reset the view",
     "Put both hands back where they began.",
     "Practice",
     {GLFW_KEY_HOME},
     {},
     [](const State& state) { return state.document().panorama != nullptr && ShowsScope(state); },
     ResetHands},
    {"instrument-probe",
     "Probe",
     "Feel and lift with the hook.",
     "Practice",
     {GLFW_KEY_5},
     {},
     Practising,
     TakeInstrument<simulation::ToolKind::kProbe>},
    {"instrument-punch",
     "Punch",
     "Bite with the basket forceps: C closes the jaws.",
     "Practice",
     {GLFW_KEY_6},
     {},
     Practising,
     TakeInstrument<simulation::ToolKind::kPunch>},
    {"instrument-shaver",
     "Shaver",
     "Take tissue away while C is held.",
     "Practice",
     {GLFW_KEY_7},
     {},
     Practising,
     TakeInstrument<simulation::ToolKind::kShaver>},
    {"instrument-grasper",
     "Grasper",
     "Blunt jaws: C closes them.",
     "Practice",
     {GLFW_KEY_8},
     {},
     Practising,
     TakeInstrument<simulation::ToolKind::kGrasper>},
    {"reset-tissues",
     "Tissue as it was",
     "Every tissue as the session began with it, its author's cuts made.",
     "Practice",
     {},
     {},
     [](const State& state) { return Practising(state) && state.practice->tissues() != nullptr; },
     [](State& state) {
       state.practice->ResetTissues();
       state.message = "The tissue is whole again.";
     }},
    {"view-0", "0°", "Look along the scope.", "Practice", {GLFW_KEY_1}, {}, ShowsScope, LookAt<0>},
    {"view-30",
     "30°",
     "Look 30° away from the scope.",
     "Practice",
     {GLFW_KEY_2},
     {},
     ShowsScope,
     LookAt<30>},
    {"view-70",
     "70°",
     "Look 70° away from the scope.",
     "Practice",
     {GLFW_KEY_3},
     {},
     ShowsScope,
     LookAt<70>},
    {"view-90",
     "90°",
     "Look straight to the side.",
     "Practice",
     {GLFW_KEY_4},
     {},
     ShowsScope,
     LookAt<90>},
    {"full-screen",
     "Full screen",
     "Fill the screen, or stop.",
     "Window",
     {GLFW_KEY_F11},
     {},
     Always,
     [](State& state) { state.full_screen = !state.full_screen; }},
    {"help",
     "?",
     "All keys and mouse actions.",
     "Window",
     {GLFW_KEY_F1},
     {},
     Always,
     [](State& state) { state.dialogs.push_back(HelpDialog{}); }},
};

}  // namespace

std::string WordsOf(const Shortcut& shortcut) {
  if (shortcut.key == 0) return "";
  std::string words = std::string(shortcut.ctrl ? "Ctrl+" : "") + (shortcut.shift ? "Shift+" : "");
  if (shortcut.key >= GLFW_KEY_F1 && shortcut.key <= GLFW_KEY_F12)
    return words + "F" + std::to_string(shortcut.key - GLFW_KEY_F1 + 1);
  switch (shortcut.key) {
    case GLFW_KEY_ESCAPE:
      return words + "Esc";
    case GLFW_KEY_DELETE:
      return words + "Delete";
    case GLFW_KEY_HOME:
      return words + "Home";
    default:
      return words + static_cast<char>(shortcut.key);
  }
}

std::span<const Command> AllCommands() { return kCommands; }

const Command& CommandOf(std::string_view id) {
  for (const Command& command : kCommands)
    if (id == command.id) return command;
  throw std::logic_error("no command " + std::string(id));
}

void Guarded(EditorState& state, const std::string& title, const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    if (error.code() == Code::kCancelled)
      state.message = "Stopped.";
    else
      state.dialogs.push_back(ErrorDialog{title, error.what()});
  } catch (const std::bad_alloc&) {
    state.dialogs.push_back(
        ErrorDialog{title, "There is not enough memory for this; use a smaller picture or mesh."});
  }
}

void Run(EditorState& state, const Command& command) {
  if (!command.enabled(state)) return;
  Guarded(state, command.words, [&] { command.run(state); });
}

void Run(EditorState& state, std::string_view id) { Run(state, CommandOf(id)); }

bool FinishWork(EditorState& state) {
  bool changed = FinishFootage(state);
  if (state.jobs.busy()) {
    const std::string words = state.jobs.words();
    Guarded(state, words, [&] { changed = state.jobs.Finish(state); });
    changed = changed || !state.jobs.busy();
  }
  changed = FinishDepth(state) || changed;
  KeepPokeFresh(state);
  Guarded(state, "Depth", [&] { KeepDepthFresh(state); });
  return changed;
}

}  // namespace arthro::app
