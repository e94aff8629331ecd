// The scope's picture and the overview as the mouse meets them: tissue that is laid on the relief,
// brushes, landmarks, clicks, and marks over both.
#pragma once

#include "app/editor/marks/target_marks.h"
#include "app/editor/panels/panels.h"
#include "app/editor/panorama_clicks.h"
#include "app/editor/pictures/footage_textures.h"
#include "app/editor/pictures/pictures.h"

namespace arthro::app {

struct SceneViews {
  EditorState& state;
  Pictures& pictures;
  PanoramaClicks& panorama_clicks;
  FootageTextures& footage_textures;
  TargetMarks& target_marks;
};

// Shows both and takes their input. True where keys move the scope.
bool ShowSceneViews(Ui& ui, const Layout& layout, const SceneViews& views);

}  // namespace arthro::app
