// The camera poses and tissue points while they are found, in the place of the large picture.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "app/steps/panorama/board/motion_plan.h"
#include "app/steps/panorama/pages/footage_panels.h"

namespace arthro::app {
namespace {

constexpr unsigned kTissue = 0x90A0C8E8, kPortal = 0xFF7CC47A;

void Drawing(Ui& ui, const MotionPlan& plan, const Area& square, const char* title) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float half = 0.5f * square.width;
  const ImVec2 middle = {square.x + half, square.y + half};
  const auto at = [&](const glm::dvec2& p) {
    return ImVec2(middle.x + half * static_cast<float>(p.x),
                  middle.y + half * static_cast<float>(p.y));
  };
  ImGui::PushClipRect({square.x, square.y}, {square.x + square.width, square.y + square.height},
                      true);
  const float dot = std::max(1.0f, ui.Px(1.2));
  for (const glm::dvec2& point : plan.points) {
    const ImVec2 p = at(point);
    draw->AddRectFilled({p.x - 0.5f * dot, p.y - 0.5f * dot}, {p.x + 0.5f * dot, p.y + 0.5f * dot},
                        kTissue);
  }
  for (const MotionPlan::Camera& camera : plan.cameras) {
    const ImVec2 tip = at(camera.tip);
    const float reach = ui.Px(14);
    if (plan.portal) draw->AddLine(at(*plan.portal), tip, 0x40EEEBE9, ui.Px(1));
    draw->AddLine(tip,
                  {tip.x + reach * static_cast<float>(camera.ahead.x),
                   tip.y + reach * static_cast<float>(camera.ahead.y)},
                  kAccent, ui.Px(1.5));
    draw->AddCircleFilled(tip, ui.Px(2.5), kAccent);
  }
  if (plan.portal) draw->AddCircle(at(*plan.portal), ui.Px(6), kPortal, 0, ui.Px(2));
  ImGui::PopClipRect();
  ui.widgets.RecordText(title);
  draw->AddText({square.x + ui.Px(4), square.y + ui.Px(4)}, kQuiet, ui.In(title).c_str());
}

}  // namespace

void MotionPicture(Ui& ui, const authoring::ReliefSoFar& so_far, const Area& area) {
  const std::string words = fmt::format(
      "{} camera poses (blue) and {} tissue points{}", so_far.cameras.size(), so_far.points.size(),
      so_far.is_in_portal_frame ? "; the portal is the green ring" : "");
  const float text = ImGui::GetTextLineHeight() + ui.Px(20), gap = ui.Px(16);
  const float edge = std::floor(
      std::max(8.0f, std::min(0.5f * (area.width - 3 * gap), area.height - text - 2 * gap)));
  const float left = std::floor(area.x + 0.5f * (area.width - 2 * edge - gap)),
              top = std::floor(area.y + 0.5f * (area.height - text - edge));
  Drawing(ui, PlanOf(so_far, PlanSide::kAbove), {left, top, edge, edge}, "From above");
  Drawing(ui, PlanOf(so_far, PlanSide::kSide), {left + edge + gap, top, edge, edge},
          "From the side");
  ui.widgets.RecordText(words);
  const std::string shown = ui.In(words);
  const ImVec2 size = ImGui::CalcTextSize(shown.c_str());
  ImGui::GetWindowDrawList()->AddText(
      {area.x + 0.5f * (area.width - size.x), top + edge + ui.Px(10)}, kQuiet, shown.c_str());
}

}  // namespace arthro::app
