// Step 1: the picture that is the backdrop, imported or made from footage.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>

#include "app/state/command.h"
#include "app/steps/panorama/adjust_board.h"
#include "app/steps/panorama/board/footage_board.h"

namespace arthro::app {

struct FootageMakers;  // panorama_run.h
struct Ui;

struct PanoramaStep {
  explicit PanoramaStep(std::function<void()> wake);

  std::optional<FootageBoard> footage;
  FootageJob footage_job;
  bool shows_footage = false;                            // the clip, not the backdrop
  AdjustBoard adjust;                                    // changes of the backdrop by mouse
  Owned<FootageMakers> makers;                           // never empty
  std::filesystem::path lens_folder;                     // presets
  Jobs frame_jobs;                                       // one frame of the footage at full size
  std::shared_ptr<const authoring::FootageRecord> seen;  // record that the board was held against
  int document_number = 0;                               // document that the board belongs to
  int rights_of = 0;  // asset whose rights are shown, of AssetsOf (sharing.h)
};
std::span<const Command> PanoramaCommands();
void PanoramaPanel(Ui& ui, EditorState& state);

// The footage's board is shown, instead of scope and overview.
bool ShowsFootage(const EditorState& state);
inline bool ShowsScope(const EditorState& state) { return !ShowsPanoramaBoard(state); }

// A picture becomes the backdrop; its projection is kept if the size is that of the old one.
void ImportPanorama(EditorState& state, const std::filesystem::path& picture);
// A panorama report says where the middle is and how many pixels a radian [method.md, File
// formats].
void ReadPanoramaReport(EditorState& state, const std::filesystem::path& report);

}  // namespace arthro::app
