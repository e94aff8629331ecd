// Blood vessels on the star-shaped surfaces of the phantom: trees that rise from the depth, with
// branches that taper to capillaries, as short arcs of the unit sphere of directions about the
// portal. Radii are angles seen from the portal.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace arthro::authoring {

struct VesselSegment {
  glm::dvec3 from{0.0}, to{0.0};          // unit directions
  double from_radius = 0, to_radius = 0;  // rad
  double depth = 0;                       // 0 on the surface, crisp and red; 1 deep, soft and dark
  double strength = 1;                    // less than 1 where the vessel rises to the surface
};

class VesselTrees {
 public:
  explicit VesselTrees(std::uint32_t seed);

  // Share of a direction that a vessel covers, 0 to 1, and the depth of the vessel.
  struct Cover {
    double amount = 0, depth = 0;
  };
  Cover At(const glm::dvec3& direction) const;

  const std::vector<VesselSegment>& segments() const { return segments_; }

 private:
  void Grow(std::uint64_t seed, glm::dvec3 at, glm::dvec3 heading, double radius, double depth,
            int generation);
  void Sort();

  std::vector<VesselSegment> segments_;
  std::vector<std::vector<std::uint32_t>>
      cells_;  // segments near each cell of a latitude-longitude grid
};

}  // namespace arthro::authoring
