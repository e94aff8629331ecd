// Size of a scene by a length that its author knows: the radius of the backdrop, its relief and the
// places of its tissues are multiplied by one factor. Tissues keep their own size, and the
// incisions stay where they are.
#pragma once

#include "authoring/project/document.h"
#include "authoring/relief/known_length.h"

namespace arthro::authoring {

// Returns the factor. Throws Error(kBadArgument) for a length outside 0.5 mm to 200 mm, a point
// outside of what was imaged, points that are too near for their uncertainty, and a factor beyond a
// tenth or ten.
double ScaleBackdrop(Document& document, const KnownLength& length);

// Multiplies the heights of the strokes, and of an imported map before them, by the factor.
void ScaleStrokes(Document& document, double factor);

}  // namespace arthro::authoring
