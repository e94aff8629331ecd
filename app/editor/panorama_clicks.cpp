#include "app/editor/panorama_clicks.h"

#include <cstdint>

#include <imgui.h>

#include "app/editor/marks/landmark_marks.h"
#include "app/state/edits.h"
#include "app/steps/tissue/hand_placing.h"
#include "app/steps/tissue/landmark_mode.h"
#include "simulation/scene/projection.h"

namespace arthro::app {

void PanoramaClicksButton(Ui& ui, const EditorState& state, PanoramaClicks& clicks,
                          const Area& area) {
  if (!JudgesPlace(state)) return;
  const char* words = clicks.is_shown ? "Show the scope" : "Show the panorama";
  // A window of its own, so that a click on it is no click into the picture.
  const ImVec2 padding = ImGui::GetStyle().FramePadding;
  const Area own{area.x + ui.Px(8), area.y + ui.Px(8), ui.WidthOf(words) + 2 * padding.x,
                 ImGui::GetTextLineHeight() + 2 * padding.y};
  const FixedWindow window(ui, "change picture", own, kInsetWindow);
  if (Button(ui, words, true, {0, 0},
             "Judge the tissue's place in the scope's picture or in the whole panorama. Landmarks "
             "can be clicked in both."))
    clicks.is_shown = !clicks.is_shown;
}

void PanoramaPicture(Ui& ui, EditorState& state, PanoramaClicks& clicks, const Area& area,
                     unsigned texture) {
  constexpr float kSlack = 4;  // px; a longer way is a drag
  const FixedWindow window(ui, "picture", area, kPictureWindow);
  const ColourImage& panorama = OrEmpty(state.document().panorama);
  const glm::dvec2 frame(area.width, area.height), size(panorama.width, panorama.height);
  ImGui::SetCursorScreenPos({area.x, area.y});
  HitArea("Panorama picture", {area.width, area.height});
  RecordItem(ui, "Panorama picture", true, "", WidgetKind::kPicture);
  const ImGuiIO& io = ImGui::GetIO();
  const glm::dvec2 pointer(io.MousePos.x - area.x, io.MousePos.y - area.y);
  if (ImGui::IsItemHovered() && io.MouseWheel != 0)
    clicks.zoom = Zoomed(clicks.zoom, io.MouseWheel, pointer, frame, size);
  const bool is_click = ImGui::IsItemDeactivated() && ImGui::IsItemHovered() &&
                        io.MouseDragMaxDistanceSqr[0] <= kSlack * kSlack;
  const bool lays = LaysOnRelief(state) && !io.KeyShift;
  const bool is_held = ImGui::IsItemActive() && !ImGui::IsItemActivated();
  const bool is_released = ImGui::IsItemDeactivated();
  if (is_held && !lays)
    clicks.zoom = Dragged(clicks.zoom, {io.MouseDelta.x, io.MouseDelta.y}, frame, size);

  const PicturePlace place = PlaceOf(clicks.zoom, frame, size);
  if (place.size.x <= 0) return;
  const ImVec2 low = {area.x + static_cast<float>(place.corner.x),
                      area.y + static_cast<float>(place.corner.y)};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->PushClipRect({area.x, area.y}, {area.x + area.width, area.y + area.height}, true);
  draw->AddRectFilled({area.x, area.y}, {area.x + area.width, area.y + area.height}, 0xFF000000);
  if (texture != 0)
    draw->AddImage(
        reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(texture)), low,
        {low.x + static_cast<float>(place.size.x), low.y + static_cast<float>(place.size.y)});
  draw->PopClipRect();

  const double px_per_pixel = place.size.x / size.x;
  const Projection& projection = state.document().scene.backdrop.projection;
  const glm::dvec2 pixel = (pointer - place.corner) / px_per_pixel - 0.5;
  const bool is_in =
      pixel.x >= -0.5 && pixel.y >= -0.5 && pixel.x < size.x - 0.5 && pixel.y < size.y - 0.5;
  if (is_in && is_click && PlacesLandmarks(state))
    TakeScenePoint(state, authoring::SightOfPanorama(state.document().scene.backdrop, pixel));
  if (is_in && is_held && lays)
    LayTissue(state, authoring::SightOfPanorama(state.document().scene.backdrop, pixel));
  if (is_released && LaysOnRelief(state)) EndDrag(state);
  MarkPanorama(ui, state, area, [&](const glm::dvec3& x) -> std::optional<glm::dvec2> {
    const auto marked = PixelFromDirection(projection, x);
    if (!marked) return std::nullopt;
    const glm::dvec2 at = place.corner + px_per_pixel * (*marked + 0.5);
    return glm::dvec2(area.x + at.x, area.y + at.y);
  });
}

}  // namespace arthro::app
