// Hand motions of a short session in the phantom. The scope goes in, surveys the joint and rolls.
// The instrument comes in, probes condyle, plateau and meniscus, lifts the meniscus' free edge on
// its hook, releases it, and leaves. The rows are those of both devices (TRACE.csv [method.md, File
// formats]), for rigs with the pivot at the device's origin, portal axes and rods of 0.2 m.
#pragma once

#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "authoring/phantom/shape/cavity.h"
#include "authoring/phantom/shape/phantom_tissue.h"

namespace arthro::authoring {

struct TraceRow {
  double t = 0;  // s
  bool is_scope = false;
  glm::dvec3 hip_in_device{0.0};  // m
  glm::dquat handle_in_device{1.0, 0.0, 0.0, 0.0};
  unsigned buttons = 0;
};

// Makes 12 s at 100 Hz, rows of both devices in turn. Speeds are continuous.
std::vector<TraceRow> MakeTrace(const Cavity& cavity, const PhantomTissue& meniscus,
                                double incision_spacing);

// Target of the probe: a point of a surface and its outward normal.
struct ProbeContact {
  glm::dvec3 x_in_portal{0.0}, normal{0.0};
  double press = 0;             // m, depth of the tip in the tissue
  double lift = 0;              // m, height over the surface before and after
  double from_t = 0, to_t = 0;  // s, interval in which the tip may be inside
};
std::vector<ProbeContact> ProbeContacts(const Cavity& cavity, const PhantomTissue& meniscus);

// Place of the probe's hook under the free edge of the meniscus: the point on the plateau below the
// edge, the outward direction under it, and up.
struct EdgeLift {
  glm::dvec3 x_in_portal{0.0}, outwards{0.0}, up{0.0};
  double from_t = 8.1, to_t = 11.1;  // s, interval in which the tip is on the plateau or near it
};
EdgeLift LiftOfEdge(const Cavity& cavity);

}  // namespace arthro::authoring
