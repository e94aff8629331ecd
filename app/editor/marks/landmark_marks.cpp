#include "app/editor/marks/landmark_marks.h"

#include <cstdint>
#include <string>
#include <utility>

#include <glm/geometric.hpp>
#include <imgui.h>

#include "app/editor/marks/model_marks.h"
#include "app/platform/theme.h"
#include "app/steps/tissue/hand_placing.h"
#include "app/steps/tissue/landmark_mode.h"
#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {
namespace {

constexpr unsigned kSceneColour = 0xFFE8C860;  // light teal

void Number(const Ui& ui, const ImVec2& at, const std::string& number, unsigned colour) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 corner{at.x + ui.Px(7), at.y - ui.Px(17)};
  draw->AddText({corner.x + 1, corner.y + 1}, kMarkShadow, number.c_str());
  draw->AddText(corner, colour, number.c_str());
}

void ModelMark(const Ui& ui, const ImVec2& at, bool is_chosen) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddCircleFilled(at, ui.Px(is_chosen ? 5.5 : 4.5), kMarkShadow);
  draw->AddCircleFilled(at, ui.Px(is_chosen ? 4.5 : 3.5), kModelColour);
}

void SceneMark(const Ui& ui, const ImVec2& at, bool is_chosen) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddCircle(at, ui.Px(6), kMarkShadow, 24, ui.Px(is_chosen ? 5 : 4));
  draw->AddCircle(at, ui.Px(6), kSceneColour, 24, ui.Px(is_chosen ? 3 : 1.8));
}

// Draws into the current ImGui window, clipped to `area`.
void DrawLandmarks(const Ui& ui, const EditorState& state, const Area& area,
                   const ToWindow& to_window) {
  const MarkClip clip(area);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const LandmarkMode& mode = state.steps.tissue->landmarks;
  const Pose& pose = state.document().scene.tissues[static_cast<std::size_t>(state.tissue)].pose;
  const auto draw_half = [&](const std::optional<glm::dvec2>& model,
                             const std::optional<glm::dvec2>& scene, std::size_t number,
                             bool is_chosen) {
    const std::string words = std::to_string(number + 1);
    if (model && scene)
      draw->AddLine(Corner(*model), Corner(*scene), 0xA0FFFFFF & kModelColour, ui.Px(1));
    if (scene) {
      SceneMark(ui, Corner(*scene), is_chosen);
      Number(ui, Corner(*scene), words, kSceneColour);
    }
    if (model) {
      ModelMark(ui, Corner(*model), is_chosen);
      Number(ui, Corner(*model), words, kModelColour);
    }
  };
  for (std::size_t i = 0; i < mode.pairs.size(); ++i)
    draw_half(to_window(pose * mode.pairs[i].x_in_tissue),
              to_window(mode.pairs[i].scene.x_in_portal), i, mode.chosen == static_cast<int>(i));
  std::optional<glm::dvec2> model, scene;
  if (mode.model) model = to_window(pose * *mode.model);
  if (mode.scene) scene = to_window(mode.scene->x_in_portal);
  draw_half(model, scene, mode.pairs.size(), true);
}

}  // namespace

void MarkScope(Ui& ui, EditorState& state, const Area& window, const Area& picture,
               const simulation::ScopeView& view, const simulation::ScopeOptics& optics) {
  if (!JudgesPlace(state) && !PlacesLandmarks(state)) return;
  const FixedWindow same(ui, "picture", window, kPictureWindow);  // appended windows are on top
  const double radius = 0.5 * picture.width;
  const auto to_window = [&](const glm::dvec3& x) -> std::optional<glm::dvec2> {
    const glm::dvec2 place = simulation::PlaceOf(optics, view, x - view.tip);
    if (!(glm::length(place) <= 1.0)) return std::nullopt;
    return glm::dvec2(picture.x + radius + radius * place.x, picture.y + radius - radius * place.y);
  };
  DrawContours(ui, state, picture, view.tip, to_window);
  if (IsOutlined(state)) DrawOutline(ui, state, picture, view.tip, to_window);
  if (PlacesLandmarks(state)) DrawLandmarks(ui, state, picture, to_window);
}

void MarkPanorama(const Ui& ui, EditorState& state, const Area& area, const ToWindow& to_window) {
  const glm::dvec3 eye(0.0);  // the panorama is seen from the portal
  if (!IsOutlined(state)) FillModel(state, area, eye, to_window, 1 - FadeOf(state));
  DrawContours(ui, state, area, eye, to_window);
  if (IsOutlined(state)) DrawOutline(ui, state, area, eye, to_window);
  if (PlacesLandmarks(state)) DrawLandmarks(ui, state, area, to_window);
}

void FadeScope(Ui& ui, const Area& window, const Area& picture, unsigned texture, double fade) {
  const FixedWindow same(ui, "picture", window, kPictureWindow);
  ImGui::GetWindowDrawList()->AddImage(
      reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(texture)), {picture.x, picture.y},
      {picture.x + picture.width, picture.y + picture.height}, {0, 0}, {1, 1},
      IM_COL32(255, 255, 255, static_cast<int>(255 * fade)));
}

void MarkOverview(Ui& ui, const EditorState& state, const Area& window,
                  const std::function<std::optional<glm::dvec2>(const glm::dvec3&)>& pixel_of) {
  if (!PlacesLandmarks(state)) return;
  const FixedWindow same(ui, "overview", window, kPictureWindow);
  DrawLandmarks(ui, state, window, [&](const glm::dvec3& x) -> std::optional<glm::dvec2> {
    const auto pixel = pixel_of(x);
    if (!pixel) return std::nullopt;
    return glm::dvec2(window.x + pixel->x + 0.5, window.y + pixel->y + 0.5);
  });
}

}  // namespace arthro::app
