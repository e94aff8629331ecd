// The paper's backdrop force as it stands, kept as a baseline to measure against [paper, 3.4]: the
// depth of the nearest pixel and its eight neighbours (Sobel) give height and normal,
// F = K · penetration · normal. Depth as imported, not smoothed. Portal frame, m.
#pragma once

#include "simulation/haptics/depth_field.h"

namespace arthro::test {

// Same meaning as DepthField::Query; weight is 0 or 1, and 0 where one of the nine is not imaged.
simulation::FieldQuery PaperQuery(const Backdrop& backdrop, const DepthMap& depth,
                                  const glm::dvec3& x_in_portal) noexcept;

}  // namespace arthro::test
