// The paper's validation figure as numbers [paper, 3.3, Fig. 7]: the pixels at the centre of the
// view as the scope is rotated about its axis, at several depths of insertion. Pixels of the
// panorama; rad, m. One function for the job and for the window.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "simulation/scene/image.h"
#include "simulation/scene/scene.h"

namespace arthro::app {

struct CentresLine {
  std::string words;                             // "5 mm"
  std::vector<std::optional<glm::dvec2>> pixel;  // one per roll, in order; none: it has no pixel
};

// White, with a grey line each `spacing` pixels from the first on.
ColourImage GridPicture(int width, int height, int spacing);

// `rod`: where the rod itself points, P of the paper.
void DrawCentres(ColourImage& picture, const std::optional<glm::dvec2>& rod,
                 const std::vector<CentresLine>& lines);

struct CentresChoice {
  double view_angle = 0;
  std::vector<double> insertion_mm = {5.0, 10.0, 15.0};
  double latitude_deg = 0, longitude_deg = 0;  // direction of the rod
  int roll_steps = 72;
};

struct CentresFigure {
  std::string table;               // CSV: insertion, roll_deg, u_px, v_px
  std::vector<CentresLine> lines;  // one per depth
  std::optional<glm::dvec2> rod;   // pixel in the direction of the rod
  int without_pixel = 0;           // centres that a gnomonic panorama has no pixel for
};

// Throws Error(kBadArgument) for an angle that is no number and a depth beyond the backdrop; `file`
// is what the sentence names.
CentresFigure CentresOf(const Backdrop& backdrop, const CentresChoice& choice,
                        const std::filesystem::path& file = {});

// The grid that stands for a panorama of that size.
ColourImage GridOf(int width, int height);

}  // namespace arthro::app
