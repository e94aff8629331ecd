// Everything that the window shows and the commands change, as values: the document with its
// history, dialogs, work under way, and the state of each step of the editor (app/steps), whose
// types only the files that use them know. No window and no OpenGL, so that tests run every
// command without a display. MakeEditorState (app/editor/every_step.h) makes a complete one.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/state/dialogs.h"
#include "app/state/jobs.h"
#include "app/state/owned.h"
#include "app/state/scene_lock.h"
#include "app/state/scratch_folder.h"
#include "app/state/script_record.h"
#include "app/state/settings/recent_scenes.h"
#include "app/state/settings/view_layout.h"
#include "app/state/settings/window_settings.h"
#include "authoring/project/history.h"
#include "simulation/scope/rod_pose.h"
#include "simulation/tissue/body/tissue_preset.h"

namespace arthro::simulation {
class Practice;
}

namespace arthro::app {

struct BrowsePreview;
struct Command;
struct DepthStep;
struct LessonsStep;
struct PanoramaStep;
struct PortalsStep;
struct PracticeStep;
struct StartPage;
struct TissueStep;

// The author's way through a scene, one page of controls each.
enum class Step { kPanorama, kDepth, kTissue, kPortals, kPractice, kExercises };

// Side from which the overview is seen: obliquely, as the operator looks in, from above, from the
// right.
enum class OverviewSide { kWhole, kFront, kTop, kRight };

// State of each step beside the document.
struct StepStates {
  Owned<PanoramaStep> panorama;
  Owned<DepthStep> depth;
  Owned<TissueStep> tissue;
  Owned<PortalsStep> portals;
  Owned<PracticeStep> practice;
  Owned<LessonsStep> lessons;
};

// The scene as this window has last read or written it.
struct SceneOnDisk {
  std::filesystem::path place;  // folder or archive; empty: none
  std::string fingerprint;      // fingerprint of scene.json or the archive (core/fingerprint.h)
};

struct EditorState {
  // `wake` ends the window's sleep, from any thread. `all_commands` outlives this.
  EditorState(authoring::Document document, StepStates step_states,
              std::span<const Command> all_commands, std::function<void()> wake_window,
              std::filesystem::path recent_file)
      : history(std::move(document)),
        steps(std::move(step_states)),
        commands(all_commands),
        jobs(wake_window),
        recent(std::move(recent_file)),
        wake(std::move(wake_window)) {
    history.MarkSaved();  // nothing was done yet
  }

  authoring::History history;
  const authoring::Document& document() const { return history.current(); }
  SceneOnDisk on_disk;
  SceneLock lock;           // mark of the scene that is edited
  int document_number = 0;  // grows when another document is begun

  Step step = Step::kPanorama;
  ViewLayout views;
  int overview_fits = 0;  // grows when the overview is to be shown from `overview_side`
  OverviewSide overview_side = OverviewSide::kWhole;
  StepStates steps;
  int tissue = -1;  // chosen one, -1 none
  std::vector<simulation::TissuePreset> tissue_presets;
  simulation::RodPose scope, instrument;  // the author's hands; practice has its own
  bool dragging = false;                  // a slider is held: preview now, full size after

  Owned<simulation::Practice> practice;  // while it runs
  bool practice_only = false;            // the practise job: no editor behind it

  std::span<const Command> commands;
  std::vector<Dialog> dialogs;  // the last one is on top and takes all input
  std::string message;          // last thing done, for the status bar
  Jobs jobs;                    // tetrahedra, reading pictures, footage to panorama
  ScratchFolder scratch;        // files of products until they are saved
  RecentScenes recent;
  Owned<StartPage> start;        // the page before a scene is open (app/files/start_page.h)
  Owned<BrowsePreview> browsed;  // preview of the file browser (app/files/browse_preview.h)
  // Small pictures of the history's steps by their id (app/files/step_pictures.h).
  std::map<long long, std::shared_ptr<const ColourImage>> step_pictures;
  WindowSettings settings;     // looks and language
  ScriptRecord record;         // record of the session
  std::function<void()> wake;  // ends the window's sleep, from any thread
  bool quit = false, full_screen = false;
};

}  // namespace arthro::app
