// Three number fields in a row, one per axis of the portal frame, with the label above.
#pragma once

#include <string>

#include <glm/vec3.hpp>

#include "app/panels/widgets.h"

namespace arthro::app {

Change AxisRow(Ui& ui, const std::string& name, glm::dvec3& values, double step, double low,
               double high, const char* format);

}  // namespace arthro::app
