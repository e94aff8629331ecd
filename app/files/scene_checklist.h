// Parts that a scene still lacks before it can be practised in and handed on, each with the page
// where it is mended.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {

struct MissingPart {
  std::string sentence;
  Step step = Step::kPanorama;
  int tissue = -1;                 // the one that lacks it; -1: none
  std::optional<TissuePage> page;  // its page
};

// The order is that of the steps.
std::vector<MissingPart> MissingParts(const EditorState& state);
// Opens the page, with the tissue chosen.
void GoToMissingPart(EditorState& state, const MissingPart& part);

}  // namespace arthro::app
