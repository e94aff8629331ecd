// Pages of the window: free functions over the editor's state, which they change only through
// commands and edits. They compute nothing.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "app/panels/fixed_window.h"
#include "app/state/editor_state.h"
#include "simulation/scene/image.h"
#include "simulation/scope/arthroscope.h"

namespace arthro::app {

// ---- Where things are, in window coordinates. ----
struct Layout {
  Area top, side, picture, overview, status;
  bool shows_picture = true, shows_overview = true;
};
Layout EditorLayout(float width, float height, float scale, const ViewLayout& views = {});
Layout PracticeLayout(float width, float height, float scale);

// Commands of the bar on top that fit into `room`, px: in a narrow window those leave first that
// the File menu has as well.
std::vector<std::string_view> BarCommands(float room,
                                          const std::function<float(std::string_view)>& width_of);

// ---- The pages. Each fills its area. ----
void TopBar(Ui& ui, EditorState& state, const Area& area);
// `notice`: what the pictures could not show as given.
void StatusBar(Ui& ui, EditorState& state, const Area& area, const std::string& notice);
void StepsPanel(Ui& ui, EditorState& state, const Area& area);
// `texture_of` gives a picture's texture; 0 where it has none.
using PictureTextureOf = std::function<unsigned(const std::shared_ptr<const ColourImage>&)>;
void Dialogs(Ui& ui, EditorState& state, const PictureTextureOf& texture_of);
void StartPagePanel(Ui& ui, EditorState& state, const Area& area,
                    const PictureTextureOf& texture_of);
void FileMenu(Ui& ui, EditorState& state);        // its button, and the menu while it is open
bool SettingsWindow(Ui& ui, EditorState& state);  // true: it is closed

// ---- Dialogs with much in them. ----
// Both may end the dialog.
void BrowseWindow(Ui& ui, EditorState& state, BrowseDialog& dialog,
                  const PictureTextureOf& texture_of);
void HistoryWindow(Ui& ui, EditorState& state, HistoryDialog& dialog,
                   const PictureTextureOf& texture_of);
void HelpWindow(Ui& ui, EditorState& state, const HelpDialog& dialog);

// ---- The pictures. `texture` is an OpenGL texture with its first row at the bottom. ----
struct PictureInput {
  bool hovered = false, focused = false;
  glm::dvec2 scope_drag{0.0}, instrument_drag{0.0};  // share of the picture's width, down positive
  double wheel = 0;                                  // notches, away from the user positive
  std::optional<glm::dvec2> clicked;  // px from the picture's top left, where nothing was dragged
  std::optional<glm::dvec2> held;     // the same while the left button is down
  bool released = false;              // it was let go
  Area area;                          // square of the picture
  bool shift = false, ctrl = false;
};
// The square picture of the scope, as large as the area lets it be.
PictureInput ScopePicture(Ui& ui, EditorState& state, const Area& area, unsigned texture);
// A square picture of the scope that is only looked at, with words in its corner.
Area LabelledPicture(Ui& ui, const Area& area, unsigned texture, const std::string& name,
                     const std::string& words);
// Pixels a side that the scope's picture fills there.
int ScopePictureSize(const Ui& ui, const EditorState& state, const Area& area);

struct OverviewInput {
  bool hovered = false, owned = false;  // owned: a drag that began here goes on
  glm::dvec2 pointer{0.0};              // in the picture, px from its top left
  bool pressed[3] = {false, false, false}, released[3] = {false, false, false};
  double wheel = 0;
  bool shift = false, ctrl = false;
  bool clicked = false;  // with the left button, and nothing was dragged
};
// `handle`: of the chosen tissue, px from the top left.
OverviewInput OverviewPicture(Ui& ui, EditorState& state, const Area& area, unsigned texture,
                              const std::optional<glm::dvec2>& handle);
// The border between the two views, which can be dragged.
void ViewSplitter(Ui& ui, EditorState& state, const Layout& layout);
// The same in a corner of the scope's picture.
OverviewInput InsetOverview(Ui& ui, const Area& area, unsigned texture);

// Moves the hand by what the user did over the picture. True when something moved.
bool ApplyPictureInput(EditorState& state, const PictureInput& input,
                       const simulation::ScopeView& view, double field_of_view);
bool ApplyHeldKeys(EditorState& state, bool picture_has_focus, double seconds);

}  // namespace arthro::app
