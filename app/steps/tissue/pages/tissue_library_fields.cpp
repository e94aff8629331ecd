// The library of models as a list of pictures, and the kinds of tears with a preview.
#include <algorithm>
#include <string>
#include <vector>

#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/tissue/library/tissue_library.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

constexpr glm::vec3 kModelColour{222, 205, 180};

void DrawThumbnail(Ui& ui, const authoring::ModelThumbnail& thumbnail, const ImVec2& low,
                   const ImVec2& size) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float side = std::min(size.x, size.y);
  const ImVec2 corner(low.x + 0.5f * (size.x - side), low.y + 0.5f * (size.y - side));
  const auto at = [&](const glm::vec2& x) {
    return ImVec2(corner.x + side * x.x, corner.y + side * x.y);
  };
  // Soft borders of neighbouring triangles would show as lines.
  const ImDrawListFlags flags = list->Flags;
  list->Flags &= ~ImDrawListFlags_AntiAliasedFill;
  for (const auto& facet : thumbnail.facets) {
    const glm::vec3 colour = facet.light * kModelColour;
    list->AddTriangleFilled(at(facet.at[0]), at(facet.at[1]), at(facet.at[2]),
                            IM_COL32(static_cast<int>(colour.x), static_cast<int>(colour.y),
                                     static_cast<int>(colour.z), 255));
  }
  list->Flags = flags;
  for (const auto& tear : thumbnail.tears) {
    std::vector<ImVec2> points;
    points.reserve(tear.size());
    for (const glm::vec2& x : tear) points.push_back(at(x));
    list->AddPolyline(points.data(), static_cast<int>(points.size()), IM_COL32(150, 20, 25, 255),
                      ImDrawFlags_None, ui.Px(2.5));
  }
}

// A picture with its title below, which runs a command, or is dragged over a view.
void ModelButton(Ui& ui, EditorState& state, const Command& command, authoring::ModelKind kind,
                 const authoring::ModelThumbnail* thumbnail, float width) {
  const float picture = ui.Px(64), line = ImGui::GetTextLineHeight();
  const ImVec2 low = ImGui::GetCursorScreenPos(), size(width, picture + line + ui.Px(10));
  const bool is_enabled = command.enabled(state);
  const bool is_pressed = HitArea(command.id, size) && is_enabled;
  const bool is_hovered = ImGui::IsItemHovered();
  if (ImGui::IsItemActive() && !is_hovered && is_enabled) {
    ModelShelf& shelf = *state.steps.tissue->shelf;
    shelf.dragged = kind;
    shelf.dragged_from = {low.x + 0.5 * size.x, low.y + 0.5 * size.y};
  }
  RecordItem(ui, command.words, is_enabled);
  CommandTip(ui, state, command);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(low, {low.x + size.x, low.y + size.y},
                      ImGui::GetColorU32(is_hovered ? ImGuiCol_FrameBgHovered : ImGuiCol_FrameBg),
                      ui.Px(4));
  if (thumbnail != nullptr)
    DrawThumbnail(ui, *thumbnail, {low.x, low.y + ui.Px(4)}, {width, picture});
  const float text = ui.WidthOf(command.words);
  list->PushClipRect(low, {low.x + size.x, low.y + size.y}, true);
  list->AddText({low.x + std::max(ui.Px(3), 0.5f * (width - text)), low.y + picture + ui.Px(6)},
                ImGui::GetColorU32(ImGuiCol_Text), ui.In(command.words).c_str());
  list->PopClipRect();
  if (is_pressed) Run(state, command);
}

void TearSlider(Ui& ui, EditorState& state, const char* name, double& value, double factor,
                double least, double most, const char* format, const char* help) {
  double shown = value / factor;
  if (!Slider(ui, name, shown, least, most, format, help)) return;
  value = shown * factor;
  state.steps.tissue->shelf->preview.reset();
}

}  // namespace

void TissueLibraryFields(Ui& ui, EditorState& state) {
  ModelShelf& shelf = *state.steps.tissue->shelf;
  int side = static_cast<int>(state.document().scene.side);
  if (Combo(ui, "Side", side, {"not stated", "left knee", "right knee"},
            "Side of the scene. The models are made for it, and for a right knee while it is not "
            "stated."))
    SetSide(state, static_cast<BodySide>(side));
  int size = static_cast<int>(shelf.size);
  if (Combo(ui, "Size", size, {"small", "average", "large"},
            "One standard deviation below the published mean, the mean, or one above."))
    shelf.size = static_cast<authoring::KneeSize>(size);
  // One picture per frame, so that the page opens at once.
  const auto entries = authoring::ModelEntries();
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (!shelf.thumbnails[i]) {
      const auto model = authoring::MakeModel(authoring::DefaultOptionsOf(entries[i].kind),
                                              authoring::KneeSide::kRight);
      shelf.thumbnails[i] = authoring::ThumbnailOf(model.surface, {});
      break;
    }
  const float width = (ImGui::GetContentRegionAvail().x - ui.Px(8)) / 2;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i % 2 == 1) ImGui::SameLine(0, ui.Px(8));
    ModelButton(ui, state, CommandOf(state, std::string("add-") + entries[i].word), entries[i].kind,
                shelf.thumbnails[i] ? &*shelf.thumbnails[i] : nullptr, width);
  }
  QuietText(ui,
            "A click lays it in the middle of the scope's view. Or drag it to its place in a "
            "picture.");
}

void TissueTearFields(Ui& ui, EditorState& state) {
  ModelShelf& shelf = *state.steps.tissue->shelf;
  authoring::TearOptions& tear = shelf.tear;
  std::vector<std::string> titles;
  for (const authoring::TearEntry& entry : authoring::TearEntries())
    titles.emplace_back(entry.title);
  int kind = static_cast<int>(tear.kind);
  if (Combo(ui, "Kind of tear", kind, titles, "The kinds of the ISAKOS classification, and roots."))
    ChooseTear(state, static_cast<authoring::TearKind>(kind));
  UpdateTearPreview(state);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, ui.Px(110));
  HitArea("tear preview", size);
  RecordItem(ui, "Preview of the tear", true, shelf.preview_fault);
  if (shelf.preview) DrawThumbnail(ui, *shelf.preview, low, size);
  if (!shelf.preview_fault.empty()) ColouredText(ui, shelf.preview_fault, kWarning);
  TearSlider(ui, state, "Place along the meniscus", tear.position, 1.0, 0.0, 1.0, "%.2f",
             "0 at the end of the anterior horn, 1 at that of the posterior horn.");
  using enum authoring::TearKind;
  const bool is_long = tear.kind == kLongitudinal || tear.kind == kBucketHandle;
  if (is_long || tear.kind == kFlap || tear.kind == kHorizontal)
    TearSlider(ui, state, "Tear length", tear.length, kMetrePerMillimetre, 2, 80, "%.0f mm",
               "Length along the meniscus.");
  if (is_long)
    TearSlider(ui, state, "Rim width", tear.rim_width, kMetrePerMillimetre, 1, 12, "%.1f mm",
               "Width of the rim outside of the tear.");
  if (tear.kind == kBucketHandle)
    TearSlider(ui, state, "Displacement", tear.displacement, kMetrePerMillimetre, 0, 12, "%.1f mm",
               "How far the handle lies from its place, towards the notch. From 0 on it is another "
               "shape, whose tetrahedra are made anew.");
  if (!is_long && tear.kind != kRoot)
    TearSlider(ui, state, "Tear reach", tear.reach, kMetrePerMillimetre, 1, 15, "%.1f mm",
               "Reach from the free edge outwards.");
  CommandButton(ui, state, "make-tear", {-FLT_MIN, 0});
}

}  // namespace arthro::app
