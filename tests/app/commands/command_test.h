// A document with its commands and without a window, and a small scene to open.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "simulation/scene/json/scene_json.h"
#include "tests/app/commands/settle.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {

// The scene as its file would be.
inline std::string Print(const EditorState& state) {
  return PrettyJson(JsonFromScene(state.document().scene));
}

class Commands : public testing::Test {
 protected:
  void Open() {
    OpenScene(state, test::WriteSmallScene(temp / "knee"));
    Settle(state);
    ASSERT_TRUE(state.dialogs.empty());
  }
  // With a depth map that was made from the picture; the scene's own is an imported one.
  void OpenAndMakeDepth() {
    Open();
    app::Run(state, "make-depth");
    Settle(state);
    app::Run(state, "save");
    Settle(state);
    OpenScene(state, temp / "knee");
    Settle(state);
    ASSERT_FALSE(state.document().is_depth_imported);
    ASSERT_FALSE(state.history.CanUndo());
  }
  // Saves as another window would, unknown to this one.
  void SaveElsewhere(const std::string& title) {
    Scene scene = ReadScene(temp / "knee");
    scene.title = title;
    WriteScene(temp / "knee/scene.json", scene);
  }
  test::TempFolder temp;
  EditorState state = MakeEditorState(NewDocument());
};

}  // namespace arthro::app
