// The paper's validation figure [paper, 3.3, Fig. 7]: where the centre of the view lies in the
// panorama as the scope is rotated about its axis, a closed line for each depth of insertion, on
// the panorama or on a regular grid of its size. Pixels of the panorama.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "simulation/scene/image.h"

namespace arthro::app {

struct CentresLine {
  std::string words;                             // "5 mm"
  std::vector<std::optional<glm::dvec2>> pixel;  // one a roll, in order; none: it has no pixel
};

// White, with a grey line each `spacing` pixels from the first on.
ColourImage GridPicture(int width, int height, int spacing);

// `rod`: where the rod itself points, P of the paper.
void DrawCentres(ColourImage& picture, const std::optional<glm::dvec2>& rod,
                 const std::vector<CentresLine>& lines);

}  // namespace arthro::app
