// Function of a solid (solid.h): negative inside, positive outside, m. Queries are noexcept and
// allocate nothing, so that the servo may make them.
//
// Each primitive gives its exact distance. A sharp joint takes the smaller or larger of two values,
// a blended one the polynomial smooth minimum [Quilez 2013]. Every value is then
// a function of slope 1 at most, so its size never exceeds the distance to the surface, and a ball
// may advance by it. It is less than the distance beside cuts and blends [method.md, Solids].
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/geometry/box3.h"
#include "simulation/scene/solids/solid.h"

namespace arthro {

struct SolidSample {
  double value = 0;          // m
  glm::dvec3 gradient{0.0};  // length at most 1; 1 where nothing is blended
};

class SolidFunction {
 public:
  // Throws Error(kBadMesh) with the sentence of FaultOfSolid.
  explicit SolidFunction(const Solid& solid);

  double Value(const glm::dvec3& x) const noexcept;
  SolidSample Sample(const glm::dvec3& x) const noexcept;
  // Unit outward normal; +z where the gradient vanishes.
  glm::dvec3 Normal(const glm::dvec3& x) const noexcept;
  // Box that holds the solid, not always the smallest.
  const Box3& bounds() const { return bounds_; }

 private:
  enum class Kind : std::uint8_t { kEllipsoid, kCapsule, kTorus, kBox, kPlane };
  struct Part {
    Kind kind = Kind::kEllipsoid;
    SolidJoin join = SolidJoin::kUnion;
    int level = 0;
    double blend = 0;
    glm::dmat3 part_from_solid{1.0};
    glm::dvec3 centre{0.0};
    glm::dvec3 size{0.0};  // radii, half sizes, or two lengths
    double rounding = 0;
  };
  template <bool has_gradient>
  SolidSample Evaluate(const glm::dvec3& x) const noexcept;
  template <bool has_gradient>
  static SolidSample OfPart(const Part& part, const glm::dvec3& x) noexcept;

  std::vector<Part> parts_;
  Box3 bounds_;
};

}  // namespace arthro
