// Lens and field of view of a scene's scope. That of a scene that is made from footage sees as wide
// as the one that filmed it.
#pragma once

#include <optional>

#include "authoring/project/document.h"

namespace arthro::app {

// The field of view of the clip's lens, and, unless that is a guess, the lens itself as the
// scope's. A lens that the round window cannot be drawn with is left out; its field of view counts
// all the same. A guess changes nothing in a scene whose scope has a lens.
void TakeFootageLens(authoring::Document& document, const Lens& lens, bool is_guessed);

// Sets the lens of the scope and its field of view; none: equisolid, of the field that is there.
// Throws Error(kBadData) for a lens that the round window cannot be drawn with.
void PutScopeLens(authoring::Document& document, const std::optional<Lens>& lens);

// Sets the field of view of the scope, rad, and of its lens, which has precedence. Returns false,
// and changes nothing, where the lens ends before.
bool PutFieldOfView(authoring::Document& document, double field_of_view);

}  // namespace arthro::app
