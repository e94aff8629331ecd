// The light that a panorama was taken in, and what the scope's own lamp makes of it. Plain values,
// no OpenGL; colours linear, 0 to 1; portal frame, m.
#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "app/view/shaders/constants.h"
#include "simulation/scene/image.h"
#include "simulation/scene/scene.h"

namespace arthro::app {

// As it can be drawn: without a depth map nothing says how far the lamp's light goes, and the
// footage keeps its own.
Backdrop WithKnownLight(Backdrop backdrop, const DepthMap& depth);

// Of what was imaged.
struct FootageLight {
  glm::dvec3 mean{0.2};    // of all of it
  glm::dvec3 bright{0.6};  // of its brightest fifth
  double metered = 0.2;    // brightness as the automatic gain measures it
};

// The panorama in blocks, some 96 along its longer side: enough for what is said of its light.
struct LightGrid {
  struct Block {
    glm::vec3 mean{0.0f};  // colour of what was imaged of it
    float share = 0;       // how much of it that is
    float relief = 0;      // m, mean
    float gain = 1;        // that evens its light
  };
  int width = 0, height = 0;
  glm::dvec2 block_px{1.0};  // panorama pixels a block
  std::vector<Block> blocks;
  double even = 0;  // share of the light's unevenness that the gains take away
  bool has_relief = false;
  const Block& at(int x, int y) const {
    return blocks[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};
LightGrid MakeLightGrid(const ColourImage& panorama, const DepthMap& depth);
// Another relief for the same panorama, of whose size it is; its colours stay what they are.
void SetRelief(LightGrid& grid, const DepthMap& depth);

// Between the blocks about a panorama pixel; beyond the edge as at it. Relief alone is quicker.
double ReliefAt(const LightGrid& grid, const glm::dvec2& pixel);
struct GridLook {
  double luma = 0;  // evened, times `share`
  double share = 0;
};
GridLook Look(const LightGrid& grid, const glm::dvec2& pixel);

// Sets the gains: the wide, smooth part of the brightness (a sixth of the picture's longer side)
// goes towards its mean by `share`, 0 to 1, at most by a factor of 3. Retinex [Land & McCann 1971],
// as footage says no more about its lamp.
void EvenLight(LightGrid& grid, double share);
// The panorama under the grid's gains.
ColourImage Evened(const ColourImage& panorama, const LightGrid& grid);

FootageLight MeasureLight(const LightGrid& grid);
// Only of what lies within `angle` (rad) of a direction from the portal; of all where that is
// nothing.
FootageLight MeasureLight(const LightGrid& grid, const Projection& projection,
                          const glm::dvec3& direction, double angle);

}  // namespace arthro::app
