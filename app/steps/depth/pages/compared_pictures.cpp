// Grey, filtered grey and relief beside the panorama, with one zoom.
#include <cmath>
#include <cstdint>

#include <imgui.h>

#include "app/steps/depth/depth_step.h"
#include "app/steps/depth/pages/depth_panels.h"

namespace arthro::app {

void ComparedPictures(Ui& ui, EditorState& state, const Area& area, const DepthTextureOf& texture) {
  const DepthBoard& board = state.steps.depth->board;
  const DepthBoard::Compared& compared = board.compared;
  const float gap = ui.Px(2);
  const float width = std::floor(0.5f * (area.width - gap)),
              height = std::floor(0.5f * (area.height - gap));
  const float right = area.x + area.width - width, below = area.y + area.height - height;
  struct Pane {
    const std::shared_ptr<const ColourImage>& picture;
    const char* words;
    float x, y;
  };
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const glm::dvec2 size(state.document().panorama->width, state.document().panorama->height);
  for (const Pane& pane : {Pane{compared.grey, "Grey", right, area.y},
                           Pane{compared.filtered, "Filtered grey", area.x, below},
                           Pane{compared.relief, "Relief", right, below}}) {
    ImGui::PushClipRect({pane.x, pane.y}, {pane.x + width, pane.y + height}, true);
    if (const unsigned id = pane.picture ? texture(pane.picture) : 0; id != 0) {
      const PicturePlace place = PlaceOf(board.zoom, {width, height}, size);
      const ImVec2 low = {pane.x + static_cast<float>(place.corner.x),
                          pane.y + static_cast<float>(place.corner.y)};
      draw->AddImage(
          reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(id)), low,
          {low.x + static_cast<float>(place.size.x), low.y + static_cast<float>(place.size.y)});
    }
    const std::string shown = ui.In(pane.words);
    const ImVec2 words = ImGui::CalcTextSize(shown.c_str());
    const ImVec2 at = {pane.x + ui.Px(10), pane.y + ui.Px(8)};
    draw->AddRectFilled({at.x - ui.Px(6), at.y - ui.Px(3)},
                        {at.x + words.x + ui.Px(6), at.y + words.y + ui.Px(4)}, 0xD0231E1B,
                        ui.Px(4));
    draw->AddText(at, kBright, shown.c_str());
    ui.widgets.RecordText(pane.words);
    ImGui::PopClipRect();
  }
}

}  // namespace arthro::app
