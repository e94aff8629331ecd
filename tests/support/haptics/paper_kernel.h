// Backdrop force of the paper, as a baseline for measurements [paper, 3.4]: the depth of the
// nearest pixel and its eight neighbours (Sobel) give height and normal, F = K · penetration ·
// normal. The depth is not smoothed. Portal frame, m.
#pragma once

#include "simulation/haptics/relief/depth_field.h"

namespace arthro::test {

// Result as of DepthField::Query; weight is 0 or 1, and 0 where one of the nine pixels is not
// imaged.
simulation::FieldQuery PaperQuery(const Backdrop& backdrop, const DepthMap& depth,
                                  const glm::dvec3& x_in_portal) noexcept;

}  // namespace arthro::test
