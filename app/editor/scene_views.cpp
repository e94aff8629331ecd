#include "app/editor/scene_views.h"

#include <optional>

#include <fmt/format.h>
#include <imgui.h>

#include "app/editor/marks/brush_marks.h"
#include "app/editor/marks/conflict_marks.h"
#include "app/editor/marks/landmark_marks.h"
#include "app/platform/script/script.h"
#include "app/state/edits.h"
#include "app/steps/depth/depth_brush.h"
#include "app/steps/depth/touch_probe.h"
#include "app/steps/tissue/hand_placing.h"
#include "app/steps/tissue/landmark_mode.h"
#include "app/steps/tissue/library/tissue_library.h"
#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {
namespace {

// Right and up from the middle of the scope's picture, in units of its radius.
glm::dvec2 PlaceInPicture(const PictureInput& input, const glm::dvec2& pixel) {
  const double edge = input.area.width;
  return {2.0 * (pixel.x + 0.5) / edge - 1.0, 1.0 - 2.0 * (pixel.y + 0.5) / edge};
}

std::optional<authoring::Sight> SightOf(const Pictures& pictures, const PictureInput& input,
                                        const glm::dvec2& pixel) {
  return authoring::SightOfScope(pictures.optics(), pictures.view(),
                                 static_cast<int>(input.area.width), pixel);
}

// A drag over the scope's picture that lays a tissue does not swing the scope.
void Lay(const SceneViews& views, PictureInput& input) {
  if (!LaysOnRelief(views.state)) return;
  if (input.held)
    if (const auto sight = SightOf(views.pictures, input, *input.held))
      LayTissue(views.state, *sight);
  if (input.held) input.scope_drag = glm::dvec2(0.0);
  if (input.released) EndDrag(views.state);
}

// A drag over the scope's picture that paints does not swing the scope.
void Paint(const SceneViews& views, PictureInput& input) {
  const bool paints = PaintsDepth(views.state);
  if (!paints && !TouchesRelief(views.state)) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const glm::dvec2 pointer(mouse.x - input.area.x - 0.5, mouse.y - input.area.y - 0.5);
  const bool is_held = paints && input.held && !input.shift;
  if (input.hovered || is_held)
    if (const auto sight = SightOf(views.pictures, input, pointer))
      PointAtRelief(views.state, *sight, is_held);
  if (is_held) input.scope_drag = glm::dvec2(0.0);
  if (paints && input.released) EndStroke(views.state);
}

// The brush or the touch over both pictures.
void BrushRings(Ui& ui, const SceneViews& views, const Layout& layout, const PictureInput& input) {
  Pictures& pictures = views.pictures;
  if (layout.shows_picture)
    MarkBrushInScope(ui, views.state, layout.picture, input.area, pictures.view(),
                     pictures.optics());
  if (layout.shows_overview)
    MarkBrushInOverview(ui, views.state, layout.overview,
                        [&](const glm::dvec3& x) { return pictures.OverviewPixelOf(x); });
  ForgetPointer(views.state);
}

bool IsIn(const Area& area, const ImVec2& at) {
  return at.x >= area.x && at.x < area.x + area.width && at.y >= area.y &&
         at.y < area.y + area.height;
}

// A model of the library that is dragged over a picture comes to lie where it is let go.
void DropModel(Ui& ui, const SceneViews& views, const Layout& layout, const PictureInput& input) {
  ModelShelf& shelf = *views.state.steps.tissue->shelf;
  if (!shelf.dragged) return;
  const ImVec2 at = ImGui::GetIO().MousePos;
  const bool is_in_scope = layout.shows_picture && IsIn(input.area, at);
  const bool is_in_overview = layout.shows_overview && IsIn(layout.overview, at);
  if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    if (is_in_scope || is_in_overview)
      ImGui::GetForegroundDrawList()->AddCircle(at, ui.Px(14), 0xFF4DB8F2, 32, ui.Px(2));
    return;
  }
  const authoring::ModelKind kind = *shelf.dragged;
  shelf.dragged.reset();
  if (!is_in_scope && !is_in_overview) return;
  std::optional<authoring::Sight> sight;
  if (is_in_scope)
    sight = SightOf(views.pictures, input, {at.x - input.area.x - 0.5, at.y - input.area.y - 0.5});
  else
    sight = views.pictures.OverviewSight({at.x - layout.overview.x, at.y - layout.overview.y});
  if (views.state.record.is_on) {
    const auto& entry = authoring::ModelEntries()[static_cast<std::size_t>(kind)];
    views.state.record.pending.push_back(fmt::format("drag {} {:g} {:g}", ScriptWord(entry.title),
                                                     (at.x - shelf.dragged_from.x) / ui.scale,
                                                     (at.y - shelf.dragged_from.y) / ui.scale));
  }
  DropLibraryModel(views.state, kind, sight);
}

bool ShowsPanorama(const SceneViews& views) {
  return views.panorama_clicks.is_shown && JudgesPlace(views.state);
}

// Marks over both pictures, and clicks into the scope's.
void Landmarks(Ui& ui, const SceneViews& views, const Layout& layout, const PictureInput& input) {
  Pictures& pictures = views.pictures;
  EditorState& state = views.state;
  if (input.clicked && PlacesLandmarks(state))
    if (const auto sight = SightOf(pictures, input, *input.clicked)) TakeScenePoint(state, *sight);
  const bool shows_scope = layout.shows_picture && !ShowsPanorama(views);
  if (shows_scope && pictures.bare_texture() != 0)
    FadeScope(ui, layout.picture, input.area, pictures.bare_texture(), FadeOf(state));
  if (shows_scope)
    MarkScope(ui, state, layout.picture, input.area, pictures.view(), pictures.optics());
  if (layout.shows_overview)
    MarkOverview(ui, state, layout.overview,
                 [&](const glm::dvec3& x) { return pictures.OverviewPixelOf(x); });
}

// Marks where the shafts of scope and instrument are in conflict.
void Conflicts(Ui& ui, const SceneViews& views, const Layout& layout, const PictureInput& input) {
  Pictures& pictures = views.pictures;
  if (layout.shows_picture)
    MarkConflictsInScope(ui, views.state, layout.picture, input.area, pictures.view(),
                         pictures.optics());
  if (layout.shows_overview)
    MarkConflictsInOverview(ui, views.state, layout.overview,
                            [&](const glm::dvec3& x) { return pictures.OverviewPixelOf(x); });
}

}  // namespace

bool ShowSceneViews(Ui& ui, const Layout& layout, const SceneViews& views) {
  EditorState& state = views.state;
  Pictures& pictures = views.pictures;
  bool is_focused = false;
  PictureInput input;
  if (layout.shows_picture && ShowsPanorama(views)) {
    views.footage_textures.BeginFrame();
    PanoramaPicture(ui, state, views.panorama_clicks, layout.picture,
                    views.footage_textures.IdOf(state.document().panorama));
    views.footage_textures.EndFrame();
    input.area = layout.picture;
  } else if (layout.shows_picture) {
    input = ScopePicture(ui, state, layout.picture, pictures.scope_texture());
    is_focused = input.focused;
    Lay(views, input);
    Paint(views, input);
    ApplyPictureInput(state, input, pictures.view(), state.document().scene.scope.field_of_view);
    if (input.clicked) pictures.ClickScope(state, PlaceInPicture(input, *input.clicked));
    views.target_marks.Draw(ui, state, layout.picture, input.area, pictures.view(),
                            pictures.optics());
  }
  if (layout.shows_overview)
    pictures.HandleOverview(
        state,
        OverviewPicture(ui, state, layout.overview, pictures.overview_texture(), pictures.handle()),
        ui.scale);
  Landmarks(ui, views, layout, input);
  Conflicts(ui, views, layout, input);
  if (layout.shows_picture) PanoramaClicksButton(ui, state, views.panorama_clicks, layout.picture);
  BrushRings(ui, views, layout, input);
  if (!ShowsPanorama(views)) DropModel(ui, views, layout, input);
  ViewSplitter(ui, state, layout);
  return is_focused;
}

}  // namespace arthro::app
