// Scale of a measured scene from lengths that its author knows. Motion measures ratios only, so the
// backdrop's radius and its relief are multiplied by one factor [method.md, Relief from motion].
#pragma once

#include "authoring/relief/editing/relief_view.h"
#include "authoring/relief/joined_scale.h"
#include "authoring/relief/known_length.h"

namespace arthro::authoring {

// Throws Error(kBadArgument) for a length outside 0.5 mm to 200 mm, a point that was not measured,
// points that are too near for their uncertainty, and a factor beyond a tenth or ten.
ScalePart ScaleFromLength(const ReliefView& view, const KnownLength& known);

// Every value times the factor.
DepthMap ScaledMap(const DepthMap& map, double factor);

}  // namespace arthro::authoring
