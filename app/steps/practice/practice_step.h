// Step 5: the practice, what holds the two hands, and what is shown and recorded of it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "app/recording/live_film.h"
#include "app/state/command.h"
#include "app/state/owned.h"
#include "app/view/drawing/disturbances.h"
#include "simulation/practice/hands/pivot_work.h"
#include "simulation/practice/hands/practice.h"
#include "simulation/practice/session_options.h"
#include "simulation/scope/camera_head.h"

namespace arthro::app {

struct Area;
struct FrameBudget;
struct GridLens;
struct RigEditing;
struct Ui;

// A hand's incision that is being found, in the practice that runs.
struct PivotCalibrating {
  simulation::DeviceRole role = simulation::DeviceRole::kScope;
  simulation::PivotWork work;
  std::string outcome;      // message about the last pivot taken over; empty: none
  bool is_unsaved = false;  // it has a place in a rig, and is not there
};

// The scope's picture alone, in a window of its own: on another monitor over all of it, else one
// that can be moved. The window that shows it takes `is_wanted` back when it is closed.
struct TraineeScreen {
  bool is_wanted = false;
  int monitor = 0;    // from 1; 0: one that the window is not on
  std::string words;  // message where the wish could not be met; empty: none
};

// Disturbances that an educator lays over the picture (app/view/drawing/disturbances.h). A
// command switches each; it keeps its last strength.
inline constexpr double kUsualStrength = 0.5;  // plain to see, and one can still work
inline constexpr double kLeastStrength = 0.05;

struct Disturbing {
  Disturbances now;  // 0: off
  // Strength that a disturbance gets when it is switched on.
  Disturbances chosen{kUsualStrength, kUsualStrength, kUsualStrength, kUsualStrength,
                      kUsualStrength, kUsualStrength, kUsualStrength};
  bool shows_panel = false;  // instead of the practice's
};

using Strength = double Disturbances::*;
struct DisturbanceSwitch {
  const char* command;  // its id
  Strength strength;
};
std::span<const DisturbanceSwitch> DisturbanceSwitches();

void ToggleDisturbance(EditorState& state, Strength strength);
// Applies now where the disturbance is on, else when it is switched on.
void SetDisturbance(EditorState& state, Strength strength, double value);

struct PracticeStep {
  explicit PracticeStep(std::function<void()> wake) : pivot_jobs(std::move(wake)) {}

  std::unique_ptr<simulation::Hands> hands =
      std::make_unique<simulation::Hands>();  // devices or mouse; outlives practices
  std::optional<simulation::Practice> poke;   // the author's live poke (tissue_poke.h)
  int poke_of = 0;                            // position of the history that it was made of
  std::optional<PivotCalibrating> calibrating;
  Jobs pivot_jobs;                             // pivot fits
  bool shows_devices = false;                  // their panel, instead of the practice's
  Owned<RigEditing> rig;                       // rig that is edited (rig_edit.h)
  Owned<GridLens> grid;                        // lens from pictures of a grid (lens/grid_lens.h)
  Owned<FrameBudget> budget;                   // costs on this machine (app/steps/budget)
  Disturbing disturbing;                       // disturbances of the picture
  simulation::CameraHead head;                 // camera head of the scope
  simulation::SessionOptions session_options;  // options of the practices to come
  simulation::TissuePace pace = simulation::TissuePace::kThread;  // stepping of deformable tissue
  std::filesystem::path rig_preset_folder;

  // The scope's picture, while it is recorded (film.h), and what became of the last film.
  FrameShape frame_shape = FrameShape::kSquare;  // shape of films and of the trainee's screen
  std::unique_ptr<LiveFilm> film;
  double film_begin = 0, film_seconds = 0;  // s of the session
  std::string film_words;
  bool is_film_lost = false;
  // Ends an attempt at an exercise, and its practice; empty: none runs.
  std::function<void(EditorState&)> end_attempt;
  // Notes in an attempt what was put back, such as the tissue; empty: none runs.
  std::function<void(EditorState&, const std::string& what)> note_reset;
  std::optional<double> asked_to_leave;  // s of the session at which leaving it asked once more
  bool shows_outside = false;            // in practice: the overview in a corner of the picture
  TraineeScreen trainee_screen;
};

// The session that runs: a practice, or the author's poke; null: none.
const simulation::Practice* LiveSession(const EditorState& state);

std::span<const Command> PracticeCommands();
std::span<const Command> DisturbanceCommands();  // disturbances of the picture
std::span<const Command> RigCommands();          // rigs, and the instruments of the scene
std::span<const Command> IncisionCommands();     // calibration of incisions

void PracticeStepPanel(Ui& ui, EditorState& state);
// Time, force and contact of the practice that runs, for pages that stand in the place of its own.
void SessionStrip(Ui& ui, const EditorState& state);
void DevicesPanel(Ui& ui, EditorState& state);
void ForcePanel(Ui& ui, EditorState& state);
void RigPanel(Ui& ui, EditorState& state);
void PracticePanel(Ui& ui, EditorState& state, const Area& area);
void DevicesPage(Ui& ui, EditorState& state, const Area& area);       // in the place of the last
void DisturbancesPage(Ui& ui, EditorState& state, const Area& area);  // there too
void IncisionPage(Ui& ui, EditorState& state, const Area& area);      // while one is calibrated

}  // namespace arthro::app
