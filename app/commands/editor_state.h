// Everything that the window shows and the commands change, as values: the document with its
// history, what is chosen, how the hands hold the scope, a running practice, open dialogs, work
// under way. No window and no OpenGL, so that tests run every command without a display.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/commands/depth_cache.h"
#include "app/commands/devices/pivot_work.h"
#include "app/commands/disturbing.h"
#include "app/commands/footage/footage_board.h"
#include "app/commands/footage/footage_makers.h"
#include "app/commands/jobs.h"
#include "app/commands/practice.h"
#include "app/commands/recent_scenes.h"
#include "app/commands/scratch_folder.h"
#include "app/commands/tissue/cut_brush.h"
#include "app/platform/file_browser_model.h"
#include "app/recording/live_film.h"
#include "authoring/project/history.h"
#include "authoring/tissue/mesh_budget.h"
#include "simulation/scope/camera_head.h"
#include "simulation/scope/rod_pose.h"
#include "simulation/tissue/body/tissue_preset.h"

namespace arthro::app {

// The author's way through a scene, one page of controls each.
enum class Step { kPanorama, kDepth, kTissue, kPortals, kPractice };

// What of the chosen tissue is worked on.
enum class TissuePage { kPlace, kMaterial, kMesh, kHold, kCut };
// What a ball on it says: it is held there, or probed.
enum class BallKind { kHeld, kProbed };

// ---- Dialogs; the last one of the stack is on top and takes all input. ----
struct ErrorDialog {
  std::string title, sentence;
};
// Before a document with unsaved changes is left.
struct GuardDialog {
  std::string action;  // "open another scene"
  std::function<void(EditorState&)> then;
};
// Before a scene is replaced that another program or window has changed since it was read here.
struct ChangedOnDiskDialog {
  std::filesystem::path place;
  std::function<void(EditorState&)> then;
};
struct BrowseDialog {
  std::string title, accept_words;
  FileBrowserModel model;
  std::function<void(EditorState&, const std::filesystem::path&)> then;
  bool asks_overwrite = false, asks_folder_name = false;
  std::string new_folder;
};
// A mesh file says nothing of its unit.
struct UnitDialog {
  std::filesystem::path surface;
  std::string unit = "mm";
};
struct HelpDialog {};
struct PracticeEndedDialog {
  double seconds = 0;
};
// A copy of unsaved work was left by a program that ended (recovery/recovery_copy.h).
struct RecoveryDialog {
  std::string title, when;
  std::filesystem::path folder;  // of its document; empty: it was never saved
  std::function<void(EditorState&)> restore, discard;
};
using Dialog = std::variant<ErrorDialog, GuardDialog, ChangedOnDiskDialog, BrowseDialog, UnitDialog,
                            HelpDialog, PracticeEndedDialog, RecoveryDialog>;

// A hand's incision that is being found, in the practice that runs.
struct PivotCalibrating {
  simulation::DeviceRole role = simulation::DeviceRole::kScope;
  PivotWork work;
  std::string outcome;      // of what was taken over last; empty: nothing was
  bool is_unsaved = false;  // it has a place in a rig, and is not there
};

// The scope's picture alone, in a window of its own: on another monitor over all of it, else one
// that can be moved. The window that shows it takes `is_wanted` back when it is closed.
struct TraineeScreen {
  bool is_wanted = false;
  int monitor = 0;    // from 1; 0: one that the window is not on
  std::string words;  // what was not as it was asked for; empty: nothing
};

// The scene as this window has last read or written it.
struct SceneOnDisk {
  std::filesystem::path place;  // folder or archive; empty: none
  std::string fingerprint;      // of scene.json or the archive (core/fingerprint.h)
};

struct EditorState {
  // `wake` ends the window's sleep, from any thread.
  explicit EditorState(authoring::Document document, std::function<void()> wake_window = {},
                       std::filesystem::path recent_file = {})
      : history(std::move(document)),
        jobs(wake_window),
        preview_jobs(wake_window),
        frame_jobs(wake_window),
        pivot_jobs(wake_window),
        recent(std::move(recent_file)),
        wake(std::move(wake_window)) {
    history.MarkSaved();  // nothing was done yet
  }

  authoring::History history;
  const authoring::Document& document() const { return history.current(); }

  // The session that runs: a practice, or the author's poke; null: none.
  const Practice* live() const { return practice ? &*practice : poke ? &*poke : nullptr; }

  SceneOnDisk on_disk;
  int document_number = 0;  // grows when another document is begun
  Step step = Step::kPanorama;
  int tissue = -1;  // chosen one, -1 none
  TissuePage tissue_page = TissuePage::kPlace;
  int ball = -1;                  // chosen one of those that the page is about, -1 none
  std::optional<BallKind> brush;  // a click on tissue in the overview puts a ball there
  double ball_radius = 2e-3;      // m, of the next one
  CutBrush cut_brush;
  int cut = -1, region = -1;   // chosen one of its `cuts` or `regions`, -1 none
  bool shows_sources = false;  // of the material's values
  authoring::MeshSize mesh_size = authoring::MeshSize::kDefault;
  simulation::RodPose scope, instrument;       // the author's hands; practice has its own
  simulation::SessionOptions session_options;  // of the practices to come
  std::unique_ptr<Hands> hands = std::make_unique<Hands>();  // what holds them; outlives practices
  std::optional<Practice> practice;                          // while it runs
  std::optional<Practice> poke;  // the author's live poke (tissue/tissue_poke.h)
  int poke_of = 0;               // position of the history that it was made of
  std::optional<PivotCalibrating> calibrating;
  bool shows_devices = false;   // their panel, instead of the practice's
  Disturbing disturbing;        // of a practice's picture
  simulation::CameraHead head;  // of a practice's scope
  bool practice_only = false;   // the practise job: no editor behind it
  // Of the scope's picture: while it is recorded (screens/film.h), and what became of the last one.
  FrameShape frame_shape = FrameShape::kSquare;  // of films and of the trainee's screen
  std::unique_ptr<LiveFilm> film;
  double film_begin = 0, film_seconds = 0;  // s of the session
  std::string film_words;
  bool is_film_lost = false;
  bool shows_outside = false;  // in practice: the overview in a corner of the picture
  TraineeScreen trainee_screen;
  std::vector<Dialog> dialogs;
  std::string message;  // last thing done, for the status bar
  Jobs jobs;            // tetrahedra, reading pictures, footage to panorama
  Jobs preview_jobs;    // depth
  Jobs frame_jobs;      // one frame of the footage at full size
  Jobs pivot_jobs;      // where the poses of a swing meet
  DepthCache depth_cache;
  authoring::DepthOptions depth_in_work;  // what preview_jobs computes
  std::function<void(EditorState&)> when_depth_is_ready;
  bool shows_as_filmed = false;  // the footage's light, to compare
  bool dragging = false;         // a slider is held: preview now, full size after
  std::optional<FootageBoard> footage;
  FootageJob footage_job;
  bool shows_footage = false;  // in the Panorama step: the clip, not the backdrop
  FootageMakers makers;
  std::filesystem::path lens_folder;  // presets
  std::filesystem::path tissue_preset_folder, rig_preset_folder;
  std::vector<simulation::TissuePreset> tissue_presets;
  simulation::TissuePace pace = simulation::TissuePace::kThread;  // of living tissue
  ScratchFolder scratch;  // files of products until they are saved
  RecentScenes recent;
  std::function<void()> wake;  // ends the window's sleep, from any thread
  bool quit = false, full_screen = false;
};

}  // namespace arthro::app
