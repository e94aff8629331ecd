// The panorama and its relief as they are uploaded: reduced where the graphics card needs it, with
// a soft end where nothing was imaged. Plain values, no OpenGL.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/image.h"
#include "simulation/scene/projection.h"

namespace arthro::app {

// Panorama pixels a texel and axis, so that no edge is longer than `max_size`.
int TextureReduction(int width, int height, int max_size);

// Means over reduction x reduction blocks; a last, thinner block takes what is left.
ColourImage ReducedPanorama(const ColourImage& panorama, int reduction);

// The relief as it is drawn, over the same part of the sphere as the panorama. Its longer side has
// at most kReliefSide texels: a wide view of 1024 px shows no more. Edges stay edges.
inline constexpr int kReliefSide = 2048;
struct ReliefTexture {
  int width = 0, height = 0;
  // Four a texel: the relief, m, 0 where it is not known; how it changes along u and along v, m a
  // texture's width and height; and 1 well inside what was imaged, falling to 0 at its edge, the
  // fall inside.
  std::vector<float> texels;
};
// `depth` may be empty: the bare sphere, all of it imaged.
ReliefTexture MakeReliefTexture(const glm::ivec2& panorama_size, const DepthMap& depth,
                                bool whole_turn);

// The highest relief of each block of block x block texels and of the eight about it, m: a ray that
// is further in there passes the block without a look at it.
struct ReliefCeiling {
  int block = 1, width = 0, height = 0;
  std::vector<float> relief;
};
ReliefCeiling MakeReliefCeiling(const ReliefTexture& relief, bool whole_turn);

// The slopes that light is thrown back by, over the same part of the sphere: means of block x block
// texels and a little of those about them, some 512 along the longer side. A depth map made of
// brightness has noise of a few tenths of a millimetre from texel to texel, which would glitter.
// Steps between what is near and what is far count for little.
struct BroadSlopes {
  int width = 0, height = 0;
  std::vector<float> slopes;  // two a block: along u and along v, as a ReliefTexture's
};
BroadSlopes MakeBroadSlopes(const ReliefTexture& relief, bool whole_turn);

// Whether the panorama is a whole turn, so that its left edge meets its right.
bool IsWholeTurn(const Projection& projection, int width);

}  // namespace arthro::app
