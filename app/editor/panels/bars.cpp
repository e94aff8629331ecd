// Layout, the bar of commands on top and the bar of messages at the bottom.
#include <algorithm>
#include <cmath>

#include <imgui.h>

#include "app/editor/panels/panels.h"
#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/state/command.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/panorama/footage_work.h"

namespace arthro::app {
namespace {

constexpr float kTopHeight = 48, kStatusHeight = 32, kSideWidth = 330;
constexpr float kPracticeWidth = 370;
constexpr float kLeastTitle = 60;       // room for the scene's name in the bar
constexpr float kOutsideShare = 0.34f;  // share of the picture's shorter side, in practice

// ImGui takes a size of 0 for "as large as the content", and textures need a pixel.
Area AtLeastAPixel(const Area& area) {
  return {area.x, area.y, std::max(area.width, 1.0f), std::max(area.height, 1.0f)};
}
Layout AtLeastAPixel(const Layout& layout) {
  return {AtLeastAPixel(layout.top),     AtLeastAPixel(layout.side),
          AtLeastAPixel(layout.picture), AtLeastAPixel(layout.overview),
          AtLeastAPixel(layout.status),  layout.shows_picture,
          layout.shows_overview};
}

// The last command of each group on the bar.
bool EndsGroup(std::string_view id) {
  return id == "save-as" || id == "history" || id == "practise";
}

}  // namespace

std::vector<std::string_view> BarCommands(float room,
                                          const std::function<float(std::string_view)>& width_of) {
  std::vector<std::string_view> shown = {"start-page", "new",  "open",    "save",    "save-as",
                                         "undo",       "redo", "history", "practise"};
  float width = 0;
  for (const std::string_view id : shown) width += width_of(id);
  for (const std::string_view id : {"save-as", "history", "new", "start-page", "open"}) {
    if (width <= room) break;
    width -= width_of(id);
    std::erase(shown, id);
  }
  return shown;
}

Layout EditorLayout(float width, float height, float scale, const ViewLayout& views) {
  const float top = kTopHeight * scale, status = kStatusHeight * scale;
  const float side = std::min(kSideWidth * scale, 0.4f * width);
  const float middle = std::max(1.0f, height - top - status);
  const float beside = width - side;
  if (views.shown != ViewLayout::Shown::kBoth) {
    const Area all = {side, top, beside, middle};
    Layout layout{
        {0, 0, width, top}, {0, top, side, middle}, all, all, {0, height - status, width, status}};
    layout.shows_picture = views.shown == ViewLayout::Shown::kScope;
    layout.shows_overview = !layout.shows_picture;
    return AtLeastAPixel(layout);
  }
  const float overview = std::floor(static_cast<float>(views.overview_share) * beside);
  const float gap = std::max(1.0f, std::floor(scale));  // between the pictures
  const float picture = beside - overview - gap;
  const float left = views.is_swapped ? overview + gap : 0,
              right = views.is_swapped ? 0 : picture + gap;
  return AtLeastAPixel(Layout{{0, 0, width, top},
                              {0, top, side, middle},
                              {side + left, top, picture, middle},
                              {side + right, top, overview, middle},
                              {0, height - status, width, status}});
}

Layout PracticeLayout(float width, float height, float scale) {
  const float side = std::min(kPracticeWidth * scale, 0.4f * width);
  Layout layout;
  layout.picture = {0, 0, width - side, height};
  layout.side = {width - side, 0, side, height};
  // In the corner that the round picture leaves free; 4:3.
  const float outside = std::floor(kOutsideShare * std::min(width - side, height)),
              edge = 8 * scale;
  layout.overview = {edge, height - 0.75f * outside - edge, outside, 0.75f * outside};
  return AtLeastAPixel(layout);
}

void TopBar(Ui& ui, EditorState& state, const Area& area) {
  const FixedWindow window(ui, "top", area, kBarWindow);
  FileMenu(ui, state);
  const float help = ui.WidthOf("Help") + ui.Px(20);
  const float between = ImGui::GetStyle().ItemSpacing.x, group = ui.Px(14);
  const auto width_of = [&](std::string_view id) {
    return ui.WidthOf(CommandOf(state, id).words) + 2 * ImGui::GetStyle().FramePadding.x + between +
           (EndsGroup(id) ? group : 0);
  };
  ImGui::SameLine();
  const float free = area.width - ImGui::GetCursorPosX() - help - ui.Px(24 + kLeastTitle);
  for (const std::string_view id : BarCommands(free, width_of)) {
    CommandButton(ui, state, id);
    ImGui::SameLine(0, EndsGroup(id) ? group : between);
  }

  // The scene's name, with a dot before it while there are changes that are not saved.
  const std::string title_of_scene = state.document().scene.title;
  const std::string name = title_of_scene.empty() ? ui.In("Untitled") : title_of_scene;
  const std::string title = (state.history.IsSaved() ? "" : "• ") + name;
  ImGui::AlignTextToFramePadding();
  const float room = area.width - help - ui.Px(24) - ImGui::GetCursorPosX();
  ImGui::PushClipRect(ImGui::GetCursorScreenPos(),
                      {ImGui::GetCursorScreenPos().x + std::max(room, 1.0f), area.y + area.height},
                      true);
  ImGui::TextUnformatted(title.c_str());
  ImGui::PopClipRect();
  ui.widgets.RecordText(title);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("%s", state.history.IsSaved()
                                ? name.c_str()
                                : (name + ": " + ui.In("changed since it was saved")).c_str());
  ImGui::SameLine(area.width - help - ui.Px(12));
  CommandButton(ui, state, "manual", {help, 0});
}

void StatusBar(Ui& ui, EditorState& state, const Area& area, const std::string& notice) {
  const FixedWindow window(ui, "status", area, kBarWindow);
  // Work under way stands on the right, unless the page says it already.
  const bool depth = DepthIsUnderWay(state);
  const bool on_page = ShowsFootage(state) && FootageIsUnderWay(state) &&
                       state.steps.panorama->footage_job.makes_panorama;
  const bool work = (state.jobs.busy() || depth) && !on_page;
  const float left = ui.Px(12), half = 0.5f * (area.width - 2 * left);
  ShortenedText(ui, state.message, state.message, work ? half - ui.Px(22) : 2 * half);
  if (!notice.empty()) {
    ui.widgets.RecordText(notice);
    ImGui::SameLine(0, ui.Px(22));
    ImGui::PushStyleColor(ImGuiCol_Text, OnGround(kWarning));
    ImGui::TextUnformatted(ui.In(notice).c_str());
    ImGui::PopStyleColor();
  }

  if (!work) return;
  const std::string words = state.jobs.busy() ? state.jobs.words() : "Depth";
  const double done =
      state.jobs.busy() ? state.jobs.done() : state.steps.depth->preview_jobs.done();
  const float bar = ui.Px(160), stop = ui.Px(64), rest = bar + stop + ui.Px(44);
  const float text = std::min(ui.WidthOf(words), half - rest);
  ImGui::SameLine(area.width - rest - text);
  ShortenedText(ui, words, words, text + 1);
  ImGui::SameLine();
  ImGui::ProgressBar(static_cast<float>(done), {bar, ImGui::GetTextLineHeight()});
  if (!state.jobs.busy()) return;
  ImGui::SameLine();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.Px(6), 0});
  if (Button(ui, "Stop", true, {stop, 0})) state.jobs.Stop();
  ImGui::PopStyleVar();
}

}  // namespace arthro::app
