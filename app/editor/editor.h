// The window's main loop: input to commands, commands to state, state to panels and pictures. Draws
// only when something changed, and sleeps otherwise.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "app/recording/frame_shape.h"
#include "app/state/settings/window_settings.h"
#include "simulation/practice/hands/hands.h"
#include "simulation/practice/session_options.h"
#include "simulation/scope/camera_head.h"

namespace arthro::app {

// An exercise that the window opens on.
struct LessonChoice {
  std::string exercise, trainee;  // id; code, empty: the attempt is not kept
  bool is_test = false;
};

struct EditorOptions {
  // Absent: the start page is shown, or the demo scene for a script.
  std::optional<std::filesystem::path> scene;
  bool practice = false;                      // the practise job: nothing but practice
  std::optional<LessonChoice> lesson;         // exercise of the practise job; none: it begins
  simulation::HandsChoice hands;              // devices that hold them
  simulation::SessionOptions session;         // options of every practice
  std::optional<std::filesystem::path> film;  // film of a practice, from its beginning
  FrameShape frame_shape = FrameShape::kSquare;
  simulation::CameraHead head;
  std::optional<int> trainee_screen;  // monitor, from 1; 0: another one
  std::string notice;                 // message for the start; empty: none
  // Settings of the window by name, as flags give them; others are as the user has set them.
  std::map<std::string, std::string> look;
  int job_minutes = 2;                 // longest work that a script waits for
  bool is_unattended = false;          // a script ends after its work, and fails with an open error
  std::optional<std::string> records;  // place of the records; none: those of the user
  // For tests.
  std::optional<std::filesystem::path> recent;    // file of the recent scenes; none: the user's
  std::optional<std::filesystem::path> recovery;  // folder of copies; none: the user's
  std::optional<std::filesystem::path> script;
  int width = 1280, height = 800;
  std::optional<double> scale;
  int frames = 0;       // quit after so many drawn frames; 0: never
  bool hidden = false;  // the window is never shown
  bool timing = false;  // says on stderr when the first picture stood
};

// Throws Error: no display, an unreadable scene, a script whose expectation did not hold.
void RunEditor(const EditorOptions& options);

}  // namespace arthro::app
