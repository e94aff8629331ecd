// The panorama and its relief as they are uploaded: reduced where the graphics card needs it, with
// a soft end where nothing was imaged. Plain values, no OpenGL.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/scene/image.h"
#include "simulation/scene/projection.h"

namespace arthro::app {

// Panorama pixels a texel and axis, so that no edge is longer than `max_size`.
int TextureReduction(int width, int height, int max_size);

// Means over reduction x reduction blocks; a last, thinner block takes what is left.
ColourImage ReducedPanorama(const ColourImage& panorama, int reduction);

// The relief at the middle of each block, m; 0 where it is not known. Edges stay edges.
std::vector<float> ReliefTexture(const DepthMap& depth, int reduction);

// The highest relief of each block of block x block texels and of the eight about it, m: a ray that
// is further in there passes the block without a look at it.
struct ReliefCeiling {
  int block = 1, width = 0, height = 0;
  std::vector<float> relief;
};
ReliefCeiling MakeReliefCeiling(const std::vector<float>& relief, int width, int height,
                                bool whole_turn);

// Whether the panorama is a whole turn, so that its left edge meets its right.
bool IsWholeTurn(const Projection& projection, int width);

// 255 well inside what was imaged, falling to 0 at its edge; the fall lies inside. Coarser than the
// panorama: it is smooth. `depth` may be empty: all was imaged.
struct ImagedMask {
  int width = 0, height = 0;
  std::vector<std::uint8_t> share;
};
ImagedMask MakeImagedMask(int width, int height, const DepthMap& depth, bool whole_turn);

// What light the footage was taken in; linear, of the imaged part.
struct FootageLight {
  glm::dvec3 mean{0.2};    // of all of it
  glm::dvec3 bright{0.6};  // of its brightest fifth
};
FootageLight MeasureLight(const ColourImage& panorama, const DepthMap& depth);

}  // namespace arthro::app
