// Scenes and ways to begin that the window shows before a scene is open: titles and small pictures
// of the recent scenes, read beside the window one after another.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/state/editor_state.h"
#include "simulation/scene/image.h"

namespace arthro::app {

struct StartScene {
  std::filesystem::path place;
  std::string title;                           // title of the scene, or the name of its folder
  std::string folder;                          // tells two scenes of one title apart
  std::string saved;                           // date and time of the last save
  std::shared_ptr<const ColourImage> picture;  // null: not read yet, or it cannot be
  std::string problem;                         // why it cannot be opened; empty: it can
  bool is_read = false;
};

struct StartPage {
  static constexpr int kPictureWidth = 320, kPictureHeight = 180;  // px

  explicit StartPage(std::function<void()> wake) : jobs(std::move(wake)) {}
  bool is_shown = false;
  int document_number = 0;  // number of the document behind it
  std::vector<StartScene> scenes;
  Jobs jobs;  // reads the next scene
};

bool ShowsStartPage(const EditorState& state);
void HideStartPage(EditorState& state);
// Shows the page with the scenes that were opened last.
void ShowStartPage(EditorState& state);
// Takes over what was read, and reads the next one. The page goes when another document is begun.
// True where there is something new.
bool KeepStartPageFresh(EditorState& state);

// Title, date and picture of a scene; a scene that cannot be read has a problem.
StartScene ReadStartScene(const std::filesystem::path& place);

std::span<const Command> StartCommands();

}  // namespace arthro::app
