#include "app/steps/panorama/pages/shown_picture.h"

#include <cmath>
#include <cstdint>

#include <glm/common.hpp>

namespace arthro::app {
namespace {

PicturePlace PlaceIn(const ShownPicture& shown) {
  return PlaceOf({}, {shown.area.width, shown.area.height},
                 {shown.picture->width, shown.picture->height});
}

}  // namespace

ImVec2 ShownPicture::OnScreen(const glm::dvec2& pixel) const {
  const PicturePlace place = PlaceIn(*this);
  const glm::dvec2 at = place.corner + (pixel + 0.5) / size * place.size;
  return {area.x + static_cast<float>(at.x), area.y + static_cast<float>(at.y)};
}

std::optional<glm::dvec2> ShownPicture::UnderPointer() const {
  const PicturePlace place = PlaceIn(*this);
  const ImVec2 pointer = ImGui::GetIO().MousePos;
  const glm::dvec2 share =
      (glm::dvec2(pointer.x - area.x, pointer.y - area.y) - place.corner) / place.size;
  if (share.x < 0 || share.y < 0 || share.x > 1 || share.y > 1) return std::nullopt;
  return share * size - 0.5;
}

void ShownPicture::Draw(const TextureOf& texture) const {
  const PicturePlace place = PlaceIn(*this);
  const ImVec2 low = {std::round(area.x + static_cast<float>(place.corner.x)),
                      std::round(area.y + static_cast<float>(place.corner.y))};
  if (const unsigned id = texture(picture); id != 0)
    ImGui::GetWindowDrawList()->AddImage(
        reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(id)), low,
        {low.x + static_cast<float>(place.size.x), low.y + static_cast<float>(place.size.y)});
}

void MarkPoint(Ui& ui, const ImVec2& at, const std::string& words) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float radius = ui.Px(6);
  draw->AddCircle(at, radius + ui.Px(1), 0xFF000000, 0, ui.Px(3));
  draw->AddCircle(at, radius, kAccent, 0, ui.Px(2));
  const ImVec2 corner = {at.x + radius + ui.Px(3), at.y - radius - ui.Px(3)};
  draw->AddText({corner.x + 1, corner.y + 1}, 0xFF000000, words.c_str());
  draw->AddText(corner, kBright, words.c_str());
}

void HintOver(Ui& ui, const Area& area, const std::string& words) {
  ui.widgets.RecordText(words);
  const std::string shown = ui.In(words);
  const ImVec2 size = ImGui::CalcTextSize(shown.c_str());
  const ImVec2 low = {area.x + ui.Px(10), area.y + ui.Px(8)};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(low, {low.x + size.x + ui.Px(16), low.y + size.y + ui.Px(8)}, 0xD0231E1B,
                      ui.Px(4));
  draw->AddText({low.x + ui.Px(8), low.y + ui.Px(4)}, kBright, shown.c_str());
}

bool HitPart(Ui& ui, const char* name, const Area& area) {
  ImGui::SetCursorScreenPos({area.x, area.y});
  const bool pressed = HitArea(name, {area.width, area.height});
  RecordItem(ui, name, true, "", WidgetKind::kPicture);
  return pressed;
}

void MarkBox(Ui& ui, const ShownPicture& shown, const glm::dvec2& corner,
             const glm::dvec2& opposite, bool is_dimmed) {
  const ImVec2 low = shown.OnScreen(glm::min(corner, opposite) - 0.5),
               high = shown.OnScreen(glm::max(corner, opposite) + 0.5);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (is_dimmed) draw->AddRectFilled(low, high, 0x80000000);
  draw->AddRect(low, high, kAccent, 0, 0, ui.Px(2));
}

}  // namespace arthro::app
