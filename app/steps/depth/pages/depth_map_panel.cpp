// Controls beside the map: its layer, the tool, and what the tool reads or needs.
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <initializer_list>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/widgets.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/depth/pages/depth_panels.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

float Half() { return ColumnWidth(2); }

// Rows of buttons, of which one is lit.
struct Entry {
  const char* command;
  bool is_chosen;
};
void Toggles(Ui& ui, EditorState& state, int columns, std::initializer_list<Entry> entries) {
  float widest = 0;
  for (const Entry& entry : entries)
    widest = std::max(widest, ui.WidthOf(CommandOf(state, entry.command).words));
  // Words of another language may be longer.
  while (columns > 1 && ColumnWidth(columns) < widest + 2 * ImGui::GetStyle().FramePadding.x)
    --columns;
  const float part = ColumnWidth(columns);
  int place = 0;
  for (const Entry& entry : entries) {
    if (place++ % columns != 0) ImGui::SameLine();
    CommandToggle(ui, state, entry.command, entry.is_chosen, {part, 0});
  }
}

void Reading(Ui& ui, const EditorState& state) {
  const DepthBoard& board = state.steps.depth->board;
  if (!board.read) {
    QuietText(ui, "Click on the map to read the distance there.");
    return;
  }
  const authoring::Document& document = state.document();
  const authoring::ReliefReading reading =
      authoring::ReadRelief(ReliefViewOf(document), *board.read);
  Text(ui, WordsOfReading(document, reading) + ".");
  if (const double share = ShareWithinOneMm(reading.sigma); std::isfinite(share))
    QuietText(ui, fmt::format("Within 1 mm with a probability of {:.0f} %.", 100 * share));
}

void Length(Ui& ui, EditorState& state) {
  DepthBoard& board = state.steps.depth->board;
  const bool is_tissue = board.kind == LengthKind::kTissue;
  const float half = Half();
  if (ToggleButton(ui, "Distance", is_tissue, true, {half, 0},
                   "A distance between two points of the tissue."))
    board.kind = LengthKind::kTissue;
  ImGui::SameLine();
  if (ToggleButton(ui, "Instrument", !is_tissue, true, {half, 0},
                   "The diameter of an instrument: click on both edges of its shaft."))
    board.kind = LengthKind::kInstrument;
  LengthPick& length = board.length();
  if (!state.document().is_depth_imported) {
    ColouredText(ui,
                 "The depth of this scene is estimated from brightness, so a length cannot set "
                 "its scale.",
                 kWarning);
    return;
  }
  if (!length.points.is_complete()) {
    QuietText(ui, length.points.from ? "Click on the second point."
                  : is_tissue        ? "Click on two points of the tissue whose distance you know."
                                     : "Click on both edges of the instrument's shaft.");
  } else {
    Text(ui, "Now the points are " + WordsOfDistance(state.document(), length.points) + " apart.");
  }
  double mm = MmFromMetres(length.metres);
  ImGui::AlignTextToFramePadding();
  Text(ui, is_tissue ? "This is" : "The diameter is");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(ui.Px(90));
  if (NumberField(ui, "Known length", mm, 0.1, 0.5, 200, "%.1f mm",
                  "Drag, or double-click to type."))
    length.metres = MetresFromMm(mm);
  CommandButton(ui, state, "set-scale", {-FLT_MIN, 0});
  const LengthPick& other = board.kind == LengthKind::kTissue ? board.instrument : board.tissue;
  if (other.is_given)
    QuietText(ui, fmt::format("The {} of {:.1f} mm counts too. Both must agree within 10 %.",
                              is_tissue ? "instrument's diameter" : "distance",
                              MmFromMetres(other.metres)));
  if (board.tissue.points.from || board.instrument.points.from)
    CommandButton(ui, state, "forget-lengths", {-FLT_MIN, 0});
}

void Profile(Ui& ui, const EditorState& state) {
  const DepthBoard& board = state.steps.depth->board;
  if (!board.profile.is_complete()) {
    QuietText(ui, board.profile.from ? "Click on the other end of the line."
                                     : "Click on both ends of a line, or drag it.");
    return;
  }
  const auto samples = authoring::SampleProfile(ReliefViewOf(state.document()), *board.profile.from,
                                                *board.profile.to);
  const authoring::RangeSpan span = authoring::RangesOf(samples);
  if (span.furthest > 0)
    Text(ui, fmt::format("Along the line the tissue lies {:.1f} to {:.1f} mm from the portal.",
                         MmFromMetres(span.nearest), MmFromMetres(span.furthest)));
  QuietText(ui, "Solid: measured. Dashed: estimated or interpolated. Band: one standard error.");
}

}  // namespace

void DepthMapPanel(Ui& ui, EditorState& state) {
  const DepthBoard& board = state.steps.depth->board;
  Heading(ui, "Colours");
  Toggles(ui, state, 3,
          {{"map-origin", board.layer == MapLayer::kOrigin},
           {"map-sigma", board.layer == MapLayer::kSigma},
           {"map-range", board.layer == MapLayer::kRange},
           {"map-shape", board.layer == MapLayer::kShape},
           {"map-masks", board.layer == MapLayer::kMasks},
           {"map-picture", board.layer == MapLayer::kPicture},
           {"map-compare", board.compares}});
  Gap(ui);
  Heading(ui, "Tool");
  Toggles(ui, state, 2,
          {{"map-read", board.tool == MapTool::kRead},
           {"map-length", board.tool == MapTool::kLength},
           {"map-profile", board.tool == MapTool::kProfile},
           {"map-brush", board.tool == MapTool::kBrush}});
  Gap(ui, 2);
  switch (board.tool) {
    case MapTool::kRead:
      return Reading(ui, state);
    case MapTool::kLength:
      return Length(ui, state);
    case MapTool::kProfile:
      return Profile(ui, state);
    case MapTool::kBrush:
      return BrushFields(ui, state);
  }
}

}  // namespace arthro::app
