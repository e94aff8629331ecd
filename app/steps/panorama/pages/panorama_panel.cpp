// Step 1: the picture that is the backdrop, and how it lies around the portal.
#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/drag.h"
#include "app/panels/fixed_window.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/panorama/footage_work.h"
#include "app/steps/panorama/pages/footage_panels.h"
#include "app/steps/panorama/pages/rights_fields.h"
#include "app/steps/panorama/panorama_step.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

// Switch between footage and backdrop, once there is a clip.
void FootageOrBackdrop(Ui& ui, EditorState& state) {
  const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
  if (ToggleButton(ui, "Footage", state.steps.panorama->shows_footage, true, {half, 0},
                   "The clip that a panorama is made from."))
    state.steps.panorama->shows_footage = true;
  ImGui::SameLine();
  if (ToggleButton(ui, "Backdrop", !state.steps.panorama->shows_footage, true, {half, 0},
                   "The panorama of the scene."))
    state.steps.panorama->shows_footage = false;
  Gap(ui, 2);
}

}  // namespace

void PanoramaPanel(Ui& ui, EditorState& state) {
  if (state.steps.panorama->footage) FootageOrBackdrop(ui, state);
  if (ShowsFootage(state)) return FootagePanel(ui, state);
  const authoring::Document document = state.document();  // a copy: edits below move it
  CommandButton(ui, state, "import-panorama", {-FLT_MIN, 0});
  CommandButton(ui, state, "make-panorama", {-FLT_MIN, 0});
  if (!document.panorama) {
    CommandButton(ui, state, "phantom-footage", {-FLT_MIN, 0});
    QuietText(
        ui,
        "A panorama is one picture of the joint, made from a video. Drop a panorama or a video "
        "on the window, or choose one here.");
    return;
  }
  QuietText(ui, fmt::format("{} × {} px", document.panorama->width, document.panorama->height));

  std::string title = document.scene.title, author = document.scene.author;
  if (TextField(ui, "Title", title, "name of the scene")) SetTitle(state, title);
  if (TextField(ui, "Author", author, "who made the scene")) SetAuthor(state, author);

  Gap(ui);
  Heading(ui, "Position around the portal");
  CommandButton(ui, state, "read-report", {-FLT_MIN, 0});
  Backdrop backdrop = document.scene.backdrop;
  Projection& projection = backdrop.projection;
  int type = projection.type == ProjectionType::kGnomonic ? 0 : 1;
  if (Combo(ui, "Projection", type, {"flat (a stitched mosaic)", "latitude and longitude"},
            "Flat: straight edges stay straight, as `arthroscene panorama` makes it.")) {
    projection.type = type == 0 ? ProjectionType::kGnomonic : ProjectionType::kEquirectangular;
    SetBackdrop(state, backdrop, "the projection");
    EndDrag(state);
  }
  Change change;
  if (type == 0)
    change = Slider(ui, "Focal length", projection.focal_px, 50, 8000, "%.0f px",
                    "Pixels per radian in the picture's middle; the panorama's report states it.");
  else
    change = Slider(ui, "Scale", projection.px_per_deg, 0.5, 100, "%.2f px/°");
  if (change) SetBackdrop(state, backdrop, "the projection");
  Drag(state, change);
  for (const int axis : {0, 1}) {
    change = Slider(ui, axis == 0 ? "Middle, from the left" : "Middle, from the top",
                    projection.centre_px[axis], 0,
                    axis == 0 ? document.panorama->width - 1 : document.panorama->height - 1,
                    "%.1f px", "The pixel that lies straight ahead of the scope's portal.");
    if (change) SetBackdrop(state, backdrop, "the picture's middle");
    Drag(state, change);
  }
  double radius_mm = MmFromMetres(backdrop.radius);
  change = Slider(ui, "Distance of the backdrop", radius_mm, 10, 150, "%.1f mm",
                  "Radius of the sphere around the portal on which the picture lies.");
  if (change) {
    backdrop.radius = MetresFromMm(radius_mm);
    SetBackdrop(state, backdrop, "the distance of the backdrop");
  }
  Drag(state, change);
  AdjustFields(ui, state);
  RightsFields(ui, state);
}

}  // namespace arthro::app
