#include "app/steps/portals/scope_lens.h"

#include <fmt/format.h>

#include "app/state/command.h"
#include "app/state/dialogs.h"
#include "app/state/edits.h"
#include "app/state/footage/footage_optics.h"
#include "simulation/core/units.h"
#include "simulation/scene/json/lens_io.h"

namespace arthro::app {
namespace {

// Raw picture of a preset's lens, px: its round window fills it. Nothing depends on its size.
constexpr int kSide = 1080;

}  // namespace

std::vector<LensChoice> ScopeLenses(const std::filesystem::path& folder) {
  std::vector<LensChoice> choices = LensChoices(folder);
  FitPresets(choices, kSide, kSide, {0.5 * (kSide - 1), 0.5 * (kSide - 1), 0.5 * kSide});
  choices.front().words = "equisolid";
  choices.front().help = "The model lens of an arthroscope, with the field of view below.";
  return choices;
}

std::optional<int> ChosenScopeLens(const std::vector<LensChoice>& lenses,
                                   const EditorState& state) {
  for (std::size_t i = 0; i < lenses.size(); ++i)
    if (lenses[i].lens == state.document().lens) return static_cast<int>(i);
  return std::nullopt;
}

std::string WordsOfScopeLens(const EditorState& state) {
  const std::optional<Lens>& lens = state.document().lens;
  if (!lens) return "equisolid";
  return fmt::format("own lens, {}, {:.0f}°", ToString(lens->model),
                     DegreesFromRadians(lens->field_of_view));
}

void ChooseScopeLens(EditorState& state, const LensChoice& choice) {
  if (!choice.problem.empty()) {
    state.dialogs.push_back(ErrorDialog{choice.words, choice.problem});
    return;
  }
  Guarded(state, "Lens of the scope", [&] {
    authoring::Document changed = state.document();
    PutScopeLens(changed, choice.lens);
    if (choice.preset && choice.preset->view_angle)
      changed.scene.scope.view_angle = *choice.preset->view_angle;
    Edit(state, "Change the lens", "", [&](auto& next) { next = changed; });
    state.message = "Lens: " + choice.words;
  });
}

void BrowseForScopeLens(EditorState& state) {
  Browse(state, BrowseFor::kOpenFile, "The lens of the scope", "Take it",
         {{"Lenses", {".json"}}, {"All files", {}}},
         [](EditorState& now, const std::filesystem::path& file) {
           ChooseScopeLens(now, LensFromFile(file));
         });
}

}  // namespace arthro::app
