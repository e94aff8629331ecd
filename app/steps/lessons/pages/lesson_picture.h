// Picture of an exercise or of a step, which its author gave, in a page.
#pragma once

#include <filesystem>

#include "app/panels/widgets.h"
#include "app/steps/lessons/lessons_step.h"

namespace arthro::app {

// Shows it at its own shape, no higher than `height` px at scale 1 and no wider than the page. A
// picture that cannot be read is a sentence; an empty name shows nothing.
void ShowLessonPicture(Ui& ui, EditorState& state, const std::filesystem::path& name, float height,
                       const LessonTexture& texture_of);

}  // namespace arthro::app
