// The scope of a scene that is made from footage: it sees as wide as the one that filmed it.
#pragma once

#include "authoring/project/document.h"

namespace arthro::app {

// The field of view of the clip's lens, and, unless that is a guess, the lens itself as the
// scope's. A lens that the round window cannot be drawn with is left out; its field of view counts
// all the same. A guess changes nothing in a scene whose scope has a lens.
void TakeFootageLens(authoring::Document& document, const Lens& lens, bool is_guessed);

}  // namespace arthro::app
