// Light in which a panorama was taken, and its correction for the scope's own lamp. Plain values,
// no OpenGL; colours linear, 0 to 1; portal frame, m.
#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "app/view/shaders/constants.h"
#include "simulation/scene/image.h"
#include "simulation/scene/scene.h"

namespace arthro::app {

// Returns the backdrop as it can be drawn: without a depth map the range of the lamp is unknown,
// and the footage keeps its own light.
Backdrop WithKnownLight(Backdrop backdrop, const DepthMap& depth);

// Light of the imaged part.
struct FootageLight {
  glm::dvec3 mean{0.2};    // mean of all of it
  glm::dvec3 bright{0.6};  // mean of its brightest fifth
  double metered = 0.2;    // brightness as the automatic gain measures it
};

// The panorama in blocks, some 96 along its longer side: enough resolution for its light.
struct LightGrid {
  struct Block {
    glm::vec3 mean{0.0f};  // mean colour of the imaged part
    float share = 0;       // share that is imaged
    float relief = 0;      // m, mean
    float gain = 1;        // factor that evens the light
  };
  int width = 0, height = 0;
  glm::dvec2 block_px{1.0};  // panorama pixels per block
  std::vector<Block> blocks;
  double even = 0;  // share of the unevenness of the light that the gains remove
  bool has_relief = false;
  const Block& at(int x, int y) const {
    return blocks[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};
LightGrid MakeLightGrid(const ColourImage& panorama, const DepthMap& depth);
// Replaces the relief of the same panorama, which it covers; colours stay.
void SetRelief(LightGrid& grid, const DepthMap& depth);

// Interpolates between the blocks around a panorama pixel; constant beyond the edge. ReliefAt alone
// is faster.
double ReliefAt(const LightGrid& grid, const glm::dvec2& pixel);
struct GridLook {
  double luma = 0;  // after the gains, times `share`
  double share = 0;
};
GridLook Look(const LightGrid& grid, const glm::dvec2& pixel);

// Sets the gains: the low-pass part of the brightness (a sixth of the picture's longer side) moves
// towards its mean by `share`, 0 to 1, by a factor of 3 at most. Retinex [Land & McCann 1971],
// since footage says nothing more about its lamp.
void EvenLight(LightGrid& grid, double share);
// Applies the grid's gains to the panorama.
ColourImage Evened(const ColourImage& panorama, const LightGrid& grid);

FootageLight MeasureLight(const LightGrid& grid);
// Measures only within `angle` (rad) of a direction from the portal; all of it when nothing was
// imaged there.
FootageLight MeasureLight(const LightGrid& grid, const Projection& projection,
                          const glm::dvec3& direction, double angle);

}  // namespace arthro::app
