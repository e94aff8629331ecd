#include "app/editor/lookback_view.h"

#include <algorithm>
#include <cmath>

#include "app/editor/marks/cue_marks.h"
#include "app/steps/lessons/lessons_step.h"

namespace arthro::app {

LookbackAreas LookbackAreasOf(const Layout& layout, bool has_expert, float scale) {
  if (!has_expert) return {layout.picture, {}, layout.overview};
  constexpr float kMostOfHeight = 0.7f;  // for the pictures
  const float gap = std::max(1.0f, std::floor(scale));
  const Area& left = layout.picture;
  const float width = layout.overview.x + layout.overview.width - left.x;
  const float half = std::floor((width - gap) / 2);
  const float high = std::floor(std::min(half, kMostOfHeight * left.height));
  return {{left.x, left.y, half, high},
          {left.x + half + gap, left.y, width - half - gap, high},
          {left.x, left.y + high, width, left.height - high}};
}

void LookbackView(Ui& ui, EditorState& state, const Pictures& pictures, const Layout& layout) {
  const bool has_expert = ExpertFrame(state) != nullptr;
  const LookbackAreas areas = LookbackAreasOf(layout, has_expert, ui.scale);
  const Area own = LabelledPicture(ui, areas.own, pictures.scope_texture(), "Picture",
                                   has_expert ? "Own attempt" : "");
  MarkTouches(ui, state, "Picture", areas.own, own, pictures.view(), pictures.optics());
  if (has_expert)
    LabelledPicture(ui, areas.expert, pictures.expert_texture(), "Expert's picture",
                    state.steps.lessons->debrief.expert_words);
  DebriefSide(ui, state, layout.side);
  DebriefPlots(ui, state, areas.plots);
}

}  // namespace arthro::app
