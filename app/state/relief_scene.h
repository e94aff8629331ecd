// The scene that a measured relief makes: panorama over the relief, depth with its errors and
// origins, and the scope that filmed it. It can be practised in as it is.
#pragma once

#include <optional>

#include "authoring/project/document.h"
#include "authoring/relief/make_relief.h"

namespace arthro::app {

// `result` must have a picture. Without a lens the scope keeps the lens of an empty document.
authoring::Document DocumentFromRelief(const authoring::ReliefResult& result,
                                       const std::optional<Lens>& lens, double view_angle);

}  // namespace arthro::app
