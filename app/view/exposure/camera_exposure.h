// Exposure of the camera behind the scope [method.md, Camera]: the range of stored levels of the
// undisturbed picture that the camera spreads over its own. A function of one picture alone, so
// that the same pose gives the same exposure; means over ranks instead of single percentiles, so
// that it moves smoothly with the pose. Plain values, no OpenGL. Levels are stored ones, 0 to 1.
#pragma once

#include <span>

#include <glm/vec3.hpp>

namespace arthro::app {

// shown = gain * stored + offset, before the toe and the shoulder of the response.
struct CameraExposure {
  double gain = 1, offset = 0;
};

// Mean levels of small parts of the window that count, without the rim and without the instrument.
// Returns no change where fewer than a tenth of `parts` count, as for a lens that is covered.
struct MeteredPart {
  glm::vec3 rgb{0.0f};
  bool counts = false;
};
CameraExposure ExposureOf(std::span<const MeteredPart> parts);

// Returns the response: linear between toe and shoulder, 0 at 0 and 1 at most. The shader
// (camera.glsl) has the same formula.
double CameraResponse(const CameraExposure& exposure, double stored);

}  // namespace arthro::app
