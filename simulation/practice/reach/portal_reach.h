// Places of a joint that scope and instrument reach through their portals, and the angle at which
// the two rods meet there (triangulation) [method.md, Reach]. Portal frame, m, rad.
//
// The scope sees a place when some pose brings it to the middle of the picture: the lens lies
// within `nearest` to `farthest` of the place and at least `clearance` from relief and tissue, and
// nothing stands between. With the angle α between rod and view and the distance w from lens to
// place X, the lens lies ρ = sqrt(|X|² − w² sin² α) − w cos α deep, on a cone of the half angle
// asin(w sin α / |X|) about the direction of X. The instrument touches a place when its straight
// rod from its own portal meets neither relief nor tissue before it.
#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/files/loaded_scene.h"

namespace arthro::simulation {

struct ReachLimits {
  double nearest = 5e-3, farthest = 25e-3;  // from lens to place
  double clearance = 2e-3;                  // radius of the scope
  // Angle between the rods: 45 to 75 degrees, the range recommended for two instruments, as
  // endoscopic knots are tied fastest at 60 degrees [Hanna, Shimi & Cuschieri 1997].
  double least_angle = 0.78539816339744828, most_angle = 1.3089969389957472;
  int places = 4000;        // about that many of the relief
  int tissue_places = 800;  // at most, of each tissue
};

struct ReachPlace {
  glm::dvec3 x{0.0};
  glm::dvec2 pixel{0.0};  // on the panorama, for a place of the relief
  double weight = 0;      // solid angle of the relief about the portal; 1 on a tissue
  int tissue = -1;        // -1: none
  int point = -1;         // index in the points that were asked for; -1: the relief, or a tissue
  // Directions of the scope's rod that show this place.
  std::vector<glm::dvec3> rods;
};

// Depends on the scope and its portal, so that spacings can be compared without doing it again.
struct ScopeReach {
  std::vector<ReachPlace> places;
  int pixel_step = 1;  // distance of the relief's places, px
};

// Empty without a panorama's relief or sphere to look at. `points`: further places, each on the
// relief or on a tissue.
ScopeReach ScopeReachOf(const LoadedScene& loaded, const ReachLimits& limits = {},
                        const std::vector<glm::dvec3>& points = {});

struct PlaceReach {
  bool is_seen = false, is_touched = false;
  double angle = 0;  // between the rods, that of the pose nearest to 60°; where seen and touched
  bool is_good = false;  // the angle lies within the limits
};

// Shares of the weight, 0 to 1.
struct ReachShares {
  double seen = 0, touched = 0, both = 0, good = 0;
  double median_angle = 0;  // over the places that are seen and touched; 0: none is
};

struct PortalReach {
  std::vector<PlaceReach> places;  // in the order of ScopeReach::places
  ReachShares relief;
  std::vector<ReachShares> tissues;  // one per tissue of the scene
};

PortalReach ReachWith(const ScopeReach& scope, const LoadedScene& loaded, double incision_spacing,
                      const ReachLimits& limits = {});

// Targets that an incision spacing shall suit. Each entry counts the same, however large it is.
struct ReachTargets {
  bool has_relief = false;
  std::vector<int> tissues;
  std::vector<int> points;  // indices in those that the reach of the scope was computed with
};

// Incision spacing, of those from −60 to 60 mm in steps of 2 mm that leave 10 mm between the
// portals, with the largest mean share of good places of the targets, then of places reached by
// both; on the side of the present spacing where two are equal. The present one without a target.
double SuggestedSpacing(const ScopeReach& scope, const LoadedScene& loaded,
                        const ReachTargets& targets, const ReachLimits& limits = {});

}  // namespace arthro::simulation
