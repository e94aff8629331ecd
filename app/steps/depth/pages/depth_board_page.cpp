// The map: the panorama under its layer, with the points, lines and strokes of the tools.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "app/platform/theme.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/depth/pages/depth_panels.h"

namespace arthro::app {
namespace {

constexpr float kProfileHeight = 190;  // at scale 1
constexpr unsigned kPlate = 0xD0231E1B;

// Pixels of the panorama on the screen.
struct Screen {
  Area area;
  PicturePlace place;
  glm::dvec2 size;  // size of the panorama

  ImVec2 At(const glm::dvec2& pixel) const {
    const glm::dvec2 at = place.corner + (pixel + 0.5) / size * place.size;
    return {area.x + static_cast<float>(at.x), area.y + static_cast<float>(at.y)};
  }
  glm::dvec2 PixelAt(const ImVec2& at) const {
    return (glm::dvec2(at.x - area.x, at.y - area.y) - place.corner) / place.size * size - 0.5;
  }
  float Length(double pixels) const { return static_cast<float>(pixels / size.x * place.size.x); }
};

bool IsInside(const glm::dvec2& pixel, const glm::dvec2& size) {
  return pixel.x >= -0.5 && pixel.y >= -0.5 && pixel.x < size.x - 0.5 && pixel.y < size.y - 0.5;
}

void Cross(const Ui& ui, const ImVec2& at, unsigned colour) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float r = ui.Px(7);
  for (const auto& [shade, width] :
       {std::pair(kMarkShadow, ui.Px(4)), std::pair(colour, ui.Px(2))}) {
    draw->AddLine({at.x - r, at.y}, {at.x + r, at.y}, shade, width);
    draw->AddLine({at.x, at.y - r}, {at.x, at.y + r}, shade, width);
  }
}

// Words on a plate, kept inside the area.
void Plate(Ui& ui, const Area& area, ImVec2 at, const std::string& words) {
  ui.widgets.RecordText(words);
  const ImVec2 size = ImGui::CalcTextSize(ui.In(words).c_str());
  at.x = std::clamp(at.x, area.x + ui.Px(8),
                    std::max(area.x + ui.Px(8), area.x + area.width - size.x - ui.Px(8)));
  at.y = std::clamp(at.y, area.y + ui.Px(6),
                    std::max(area.y + ui.Px(6), area.y + area.height - size.y - ui.Px(6)));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled({at.x - ui.Px(6), at.y - ui.Px(3)},
                      {at.x + size.x + ui.Px(6), at.y + size.y + ui.Px(4)}, kPlate, ui.Px(4));
  draw->AddText(at, kBright, ui.In(words).c_str());
}

void Pair(Ui& ui, const Screen& screen, const PointPair& points, const std::string& words,
          unsigned colour) {
  if (!points.from) return;
  const ImVec2 a = screen.At(*points.from);
  if (points.to) {
    const ImVec2 b = screen.At(*points.to);
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddLine(a, b, kMarkShadow, ui.Px(4));
    draw->AddLine(a, b, colour, ui.Px(2));
    Cross(ui, b, colour);
    if (!words.empty())
      Plate(ui, screen.area, {0.5f * (a.x + b.x) + ui.Px(10), 0.5f * (a.y + b.y) + ui.Px(10)},
            words);
  }
  Cross(ui, a, colour);
}

void Marks(Ui& ui, const EditorState& state, const Screen& screen) {
  const DepthBoard& board = state.steps.depth->board;
  const authoring::Document& document = state.document();
  if (board.tool == MapTool::kRead && board.read) {
    const ImVec2 at = screen.At(*board.read);
    Cross(ui, at, kBright);
    Plate(ui, screen.area, {at.x + ui.Px(14), at.y + ui.Px(10)},
          WordsOfReading(document, authoring::ReadRelief(ReliefViewOf(document), *board.read)));
  }
  if (board.tool == MapTool::kLength)
    for (const LengthPick* length : {&board.tissue, &board.instrument})
      Pair(ui, screen, length->points, WordsOfDistance(document, length->points),
           length == &board.length() ? kBright : kQuiet);
  if (board.tool == MapTool::kProfile) Pair(ui, screen, board.profile, "", kAccent);
  if (board.tool != MapTool::kBrush || !(ImGui::IsItemHovered() || ImGui::IsItemActive())) return;
  // The outer ring is the size, the inner one the hard core.
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetIO().MousePos;
  const float radius = std::max(1.0f, screen.Length(BrushRadius(state)));
  const float core = radius * static_cast<float>(board.brush.stroke.hardness);
  draw->AddCircle(at, radius, kMarkShadow, 64, ui.Px(3));
  draw->AddCircle(at, radius, kBright, 64, ui.Px(1.5));
  if (core >= ui.Px(3)) draw->AddCircle(at, core, 0x90FFFFFF, 48, ui.Px(1));
}

// Wheel, drags and clicks over the map, which is ImGui's last item.
void Take(EditorState& state, const Screen& screen) {
  DepthBoard& board = state.steps.depth->board;
  const ImGuiIO& io = ImGui::GetIO();
  const glm::dvec2 frame = {screen.area.width, screen.area.height};
  const bool is_hovered = ImGui::IsItemHovered();
  if (is_hovered && io.MouseWheel != 0)
    board.zoom =
        Zoomed(board.zoom, io.MouseWheel,
               {io.MousePos.x - screen.area.x, io.MousePos.y - screen.area.y}, frame, screen.size);
  if (ImGui::IsItemActive() && (io.MouseDown[1] || io.MouseDown[2]))
    board.zoom = Dragged(board.zoom, {io.MouseDelta.x, io.MouseDelta.y}, frame, screen.size);
  const glm::dvec2 pixel = screen.PixelAt(io.MousePos);
  const bool is_inside = IsInside(pixel, screen.size);
  if (is_hovered && is_inside && ImGui::IsMouseClicked(0)) {
    ClickDepth(state, pixel);
  } else if (ImGui::IsItemActive() && io.MouseDown[0] && is_inside) {
    if (board.tool == MapTool::kBrush && board.brush.is_down()) PaintDepth(state, pixel);
    if (board.tool == MapTool::kRead) board.read = pixel;
  }
  if (!ImGui::IsMouseReleased(0)) return;
  EndStroke(state);
  // A line that was dragged ends where the button was released.
  constexpr float kDrag = 6;  // px
  const bool is_pair = board.tool == MapTool::kLength || board.tool == MapTool::kProfile;
  if (is_pair && is_hovered && is_inside && io.MouseDragMaxDistanceSqr[0] > kDrag * kDrag) {
    const PointPair& points =
        board.tool == MapTool::kProfile ? board.profile : board.length().points;
    if (points.from && !points.to) ClickDepth(state, pixel);
  }
}

void Legend(Ui& ui, const Area& area, const MapLegend& legend) {
  if (legend.entries.empty() && legend.ramp.empty()) return;
  const float line = ImGui::GetTextLineHeight() + ui.Px(4), box = ui.Px(14), pad = ui.Px(10);
  const float ramp = ui.Px(180);
  float width = 0;
  for (const auto& entry : legend.entries)
    width = std::max(width, box + ui.Px(8) + ui.WidthOf(entry.words));
  int lines = static_cast<int>(legend.entries.size());
  const std::string ends = legend.low + legend.high;
  if (!legend.ramp.empty()) {
    lines += 3;
    width = std::max({width, ramp, ui.WidthOf(legend.ramp_words),
                      ImGui::CalcTextSize(ends.c_str()).x + ui.Px(24)});
  }
  const ImVec2 low = {area.x + ui.Px(12), area.y + area.height - ui.Px(12) - 2 * pad -
                                              static_cast<float>(lines) * line};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(low, {low.x + width + 2 * pad, area.y + area.height - ui.Px(12)}, kPlate,
                      ui.Px(4));
  float y = low.y + pad;
  const float x = low.x + pad;
  const auto text = [&](float at, const std::string& words, unsigned colour) {
    ui.widgets.RecordText(words);
    draw->AddText({at, y}, colour, ui.In(words).c_str());
  };
  if (!legend.ramp.empty()) {
    text(x, legend.ramp_words, kBright);
    y += line;
    const float part = width / static_cast<float>(legend.ramp.size() - 1);
    for (std::size_t i = 0; i + 1 < legend.ramp.size(); ++i)
      draw->AddRectFilledMultiColor({x + part * static_cast<float>(i), y},
                                    {x + part * static_cast<float>(i + 1), y + box}, legend.ramp[i],
                                    legend.ramp[i + 1], legend.ramp[i + 1], legend.ramp[i]);
    y += line;
    text(x, legend.low, kQuiet);
    text(x + width - ui.WidthOf(legend.high), legend.high, kQuiet);
    y += line;
  }
  for (const auto& entry : legend.entries) {
    draw->AddRectFilled({x, y + ui.Px(1)}, {x + box, y + ui.Px(1) + box}, entry.colour, ui.Px(2));
    text(x + box + ui.Px(8), entry.words, kBright);
    y += line;
  }
}

}  // namespace

void DepthBoardPage(Ui& ui, EditorState& state, const Area& area, const DepthTextureOf& texture) {
  const FixedWindow window(ui, "depth board", area, kPictureWindow);
  DepthBoard& board = state.steps.depth->board;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled({area.x, area.y}, {area.x + area.width, area.y + area.height}, 0xFF000000);
  Area pictures = area;  // above the profile
  if (board.tool == MapTool::kProfile)
    pictures.height = std::max(1.0f, area.height - ui.Px(kProfileHeight));
  Area map = pictures;
  if (board.compares) {
    // The map keeps the upper left quarter, in which its tools work.
    ComparedPictures(ui, state, pictures, texture);
    map.width = std::floor(0.5f * pictures.width) - ui.Px(1);
    map.height = std::floor(0.5f * pictures.height) - ui.Px(1);
  }
  ImGui::SetCursorScreenPos({map.x, map.y});
  HitArea("Depth map", {map.width, map.height},
          ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
              ImGuiButtonFlags_MouseButtonMiddle);
  RecordItem(ui, "Depth map", true, "", WidgetKind::kPicture);
  const auto& panorama = state.document().panorama;
  Screen screen;
  screen.area = map;
  screen.size = {panorama->width, panorama->height};
  screen.place = PlaceOf(board.zoom, {map.width, map.height}, screen.size);
  ImGui::PushClipRect({map.x, map.y}, {map.x + map.width, map.y + map.height}, true);
  if (const unsigned id = board.drawn.picture ? texture(board.drawn.picture) : 0; id != 0) {
    const ImVec2 low = {std::round(map.x + static_cast<float>(screen.place.corner.x)),
                        std::round(map.y + static_cast<float>(screen.place.corner.y))};
    draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(id)), low,
                   {low.x + static_cast<float>(screen.place.size.x),
                    low.y + static_cast<float>(screen.place.size.y)});
    if (const unsigned patch = board.patch.picture ? texture(board.patch.picture) : 0; patch != 0) {
      const glm::dvec2 from = board.patch.low * screen.place.size,
                       to = board.patch.high * screen.place.size;
      draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(patch)),
                     {low.x + static_cast<float>(from.x), low.y + static_cast<float>(from.y)},
                     {low.x + static_cast<float>(to.x), low.y + static_cast<float>(to.y)});
    }
  }
  Marks(ui, state, screen);
  Take(state, screen);
  Legend(ui, map, board.drawn.legend);
  ImGui::PopClipRect();
  if (board.tool == MapTool::kProfile)
    ProfileFigure(ui, state,
                  {area.x, area.y + pictures.height, area.width, area.height - pictures.height});
}

}  // namespace arthro::app
