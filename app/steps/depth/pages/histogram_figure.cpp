// Histogram of the greys with handles for the percentiles, and presets of the colour filter.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/widgets.h"
#include "app/state/edits.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/depth/pages/depth_panels.h"
#include "authoring/depth/colour_filter.h"
#include "authoring/depth/depth_histogram.h"

namespace arthro::app {
namespace {

constexpr float kFigureHeight = 72;    // at scale 1
constexpr double kLeastBetween = 0.5;  // %, between the handles

struct Handle {
  const char* name;
  double* percentile;
  double low, high;  // % that it may have
};

}  // namespace

void DepthHistogramFigure(Ui& ui, EditorState& state) {
  const auto& histogram = DepthHistogramOf(state);
  if (!histogram) return;
  authoring::DepthOptions options = state.document().depth_options;
  const bool is_grey = options.estimator == authoring::DepthEstimator::kPaper;
  QuietText(ui, is_grey ? "Greys, with the percentiles of far and near"
                        : "Nearness, with the percentiles of far and near");
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float width = std::max(ui.Px(40), ImGui::GetContentRegionAvail().x),
              height = ui.Px(kFigureHeight), foot = ui.Px(12);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(low, {low.x + width, low.y + height}, 0xFF231E1B, ui.Px(3));
  double most = 1e-9;
  for (const double share : histogram->share) most = std::max(most, share);
  const float bin = width / authoring::DepthHistogram::kBins;
  for (int i = 0; i < authoring::DepthHistogram::kBins; ++i) {
    // A square root shows the few pixels of the tails as well.
    const auto part =
        static_cast<float>(std::sqrt(histogram->share[static_cast<std::size_t>(i)] / most));
    const float x = low.x + bin * static_cast<float>(i);
    draw->AddRectFilled({x, low.y + height - foot - part * (height - foot - ui.Px(4))},
                        {x + bin, low.y + height - foot}, kQuiet);
  }
  const Handle handles[] = {{"Handle of the low percentile", &options.low_percentile, 0,
                             options.high_percentile - kLeastBetween},
                            {"Handle of the high percentile", &options.high_percentile,
                             options.low_percentile + kLeastBetween, 100}};
  std::string changed;
  for (const Handle& handle : handles) {
    const auto place =
        static_cast<float>(authoring::PlaceOfPercentile(*histogram, *handle.percentile));
    const float x = low.x + place * width, reach = ui.Px(6);
    ImGui::SetCursorScreenPos({std::clamp(x - reach, low.x, low.x + width - 2 * reach), low.y});
    HitArea(handle.name, {2 * reach, height});
    RecordItem(ui, handle.name, true, fmt::format("{:.1f} %", *handle.percentile));
    const bool is_held = ImGui::IsItemActive();
    const unsigned colour = is_held || ImGui::IsItemHovered() ? kBright : kAccent;
    draw->AddLine({x, low.y}, {x, low.y + height - foot}, colour, ui.Px(2));
    draw->AddTriangleFilled({x, low.y + height - foot}, {x - ui.Px(6), low.y + height},
                            {x + ui.Px(6), low.y + height}, colour);
    if (is_held && !ImGui::IsItemActivated()) {
      state.dragging = true;
      const double wanted = authoring::PercentileAt(
          *histogram, static_cast<double>((ImGui::GetIO().MousePos.x - low.x) / width));
      *handle.percentile = std::clamp(wanted, handle.low, std::max(handle.low, handle.high));
      changed = handle.name;
    }
    if (ImGui::IsItemDeactivated()) EndDrag(state);
  }
  if (!changed.empty()) SetDepthOptions(state, options, changed);
  ImGui::SetCursorScreenPos({low.x, low.y + height + ui.Px(6)});
  ImGui::Dummy({0, 0});
}

void ColourFilterField(Ui& ui, EditorState& state) {
  authoring::DepthOptions options = state.document().depth_options;
  std::vector<std::string> words;
  std::string help = "Weights of red, green and blue:";
  for (const authoring::ColourFilter& filter : authoring::kColourFilters) {
    words.emplace_back(filter.words);
    help += fmt::format("\n{}: {}", filter.words, filter.help);
  }
  int chosen = authoring::ColourFilterOf(options);
  if (chosen < 0) {
    chosen = static_cast<int>(words.size());
    words.emplace_back("Own weights");
  }
  ImGui::BeginDisabled(!HasEffect(options, "red_weight"));
  const bool is_changed = Combo(ui, "Colour filter", chosen, words, help.c_str());
  ImGui::EndDisabled();
  if (is_changed && chosen < static_cast<int>(std::size(authoring::kColourFilters))) {
    authoring::SetColourFilter(options, authoring::kColourFilters[chosen]);
    SetDepthOptions(state, options, "Colour filter");
    EndDrag(state);
  }
}

}  // namespace arthro::app
