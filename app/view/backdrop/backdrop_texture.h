// Panorama and relief as they are uploaded: reduced when the graphics card needs it, with a soft
// border where nothing was imaged. Plain values, no OpenGL.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/image.h"
#include "simulation/scene/pixel_bounds.h"
#include "simulation/scene/projection.h"

namespace arthro::app {

// Panorama pixels per texel and axis, so that no edge is longer than `max_size`.
int TextureReduction(int width, int height, int max_size);

// Means over reduction x reduction blocks; the last block takes the remainder.
ColourImage ReducedPanorama(const ColourImage& panorama, int reduction);

// Relief over the same part of the sphere as the panorama. Its longer side has at most kReliefSide
// texels: a wide view of 1024 px shows no more. Edges stay edges.
inline constexpr int kReliefSide = 2048;
// Width of the band outside of the imaged part in which the picture fades, as a share of the
// panorama's longer edge.
inline constexpr double kEndShare = 1.0 / 12.0;
struct ReliefTexture {
  int width = 0, height = 0;
  // Four values per texel: relief, m, continued where it is unknown; its slopes along u and v, m
  // per texture width and height; and a weight, 1 well inside the imaged part, 0 at its edge, -1
  // well outside of it. The edge of the panorama is none: it is 1 there.
  std::vector<float> texels;
};
// Values of a depth map at the texels of its relief; those of a large map are some of its pixels.
DepthMap SampledRelief(const DepthMap& map);
// Replaces the samples of a part of the map, which lies at `box` in the whole of that size.
void PutSampled(const DepthMap& part, const PixelBounds& box, const glm::ivec2& whole,
                DepthMap& sampled);

// Adds the difference of two maps within `changed`, low-passed over some 4 px, to samples that have
// no noise. Unknown depths stay or become unknown, and new ones are taken as they are.
void ShiftSampled(const DepthMap& before, const DepthMap& after, const PixelBounds& changed,
                  DepthMap& sampled);

// An empty `depth` gives the bare sphere, all of it imaged. `sigma`: its standard error, of its
// size, for the outlines; empty: not known.
ReliefTexture MakeReliefTexture(const glm::ivec2& panorama_size, const DepthMap& depth,
                                bool whole_turn, const DepthMap& sigma = {});
// The same, of samples. `depth`: the whole map, of which only the unknown part counts.
ReliefTexture MakeReliefTexture(const glm::ivec2& panorama_size, const DepthMap& depth,
                                DepthMap sampled, bool whole_turn, const DepthMap& sampled_sigma);

// Maximum of the relief over each block of block x block texels and its eight neighbours, m: a ray
// above it passes the block without a texture read.
struct ReliefCeiling {
  int block = 1, width = 0, height = 0;
  std::vector<float> relief;
};
ReliefCeiling MakeReliefCeiling(const ReliefTexture& relief, bool whole_turn);

// Slopes for diffuse shading, over the same part of the sphere: means of block x block texels and a
// little of their neighbours, some 512 along the longer side. A depth map from brightness has noise
// of a few tenths of a millimetre between texels, which would glitter. Steps between near and far
// parts have a low weight. `blur`: standard deviation of a further smoothing, texels of the relief,
// which a relief with known noise asks for.
struct BroadSlopes {
  int width = 0, height = 0;
  // Three values per block: slopes along u and along v, like those of a ReliefTexture; and 1, or 0
  // near steps, where no slope is that of a surface.
  std::vector<float> slopes;
};
BroadSlopes MakeBroadSlopes(const ReliefTexture& relief, bool whole_turn, double blur = 0);

// Whether the panorama covers a full turn, so that its left edge meets its right.
bool IsWholeTurn(const Projection& projection, int width);

}  // namespace arthro::app
