// Places of a tissue and the cuts of its author, in the tissue's own frame at rest (before the
// scale of its pose), m. Places are balls instead of lists of nodes, so that they remain valid for
// a new mesh. Removing a cut from the list undoes it.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/frames.h"
#include "simulation/scene/limits/scene_limits.h"

namespace arthro {

struct Ball {
  glm::dvec3 centre{0.0};
  double radius = 1e-3;
  friend bool operator==(const Ball&, const Ball&) = default;
  template <class V>
  void Visit(V&& v) {
    v("centre", centre, Required{kCoordinate}, "m", "Centre of the ball.");
    v("radius", radius, Required{kLength}, "m", "Radius of the ball.");
  }
};

// Name under which volume removed outside of all regions is counted; no region has it.
inline constexpr const char* kElsewhere = "elsewhere";
inline constexpr const char* kReservedRegions[] = {kElsewhere};

// Part of a tissue whose removed volume is counted by name, such as "posterior horn".
struct Region {
  std::string name;
  Ball ball;
  friend bool operator==(const Region&, const Region&) = default;
  template <class V>
  void Visit(V&& v) {
    v("name", name, Name{kReservedRegions, "reports use for everything outside of regions"}, "",
      "Name of the region.");
    ball.Visit(v);
  }
};

// A bite of round jaws, or a pass of the shaver; a ball where both ends are one.
struct CapsuleCut {
  static constexpr const char* kType = "capsule";
  static constexpr const char* kHelp = "A round bite, or a pass of a shaver, from a to b.";
  glm::dvec3 a{0.0}, b{0.0};
  double radius = 1e-3;
  friend bool operator==(const CapsuleCut&, const CapsuleCut&) = default;
  template <class V>
  void Visit(V&& v) {
    v("a", a, Required{kCoordinate}, "m", "Centre of one end.");
    v("b", b, Required{kCoordinate}, "m", "Centre of the other end.");
    v("radius", radius, Required{kLength}, "m", "Radius of the cut.");
  }
};
// A bite of square jaws: what lies in a box.
struct BoxCut {
  static constexpr const char* kType = "box";
  static constexpr const char* kHelp = "A square bite.";
  Rigid3 rest_from_box;
  glm::dvec3 half{1e-3};
  friend bool operator==(const BoxCut&, const BoxCut&) = default;
  template <class V>
  void Visit(V&& v) {
    v("centre", rest_from_box.translation, Required{kCoordinate}, "m", "Centre of the box.");
    v("quaternion", rest_from_box.rotation, Any{}, "", "Turns the box about its centre.");
    v("half", half, Required{kLength}, "m", "Half of its size along its own axes.");
  }
};
// A slot along a path on the surface, `depth` deep along `into`. It begins `lead` before the path,
// so that it is open. A slot narrower than 1.5 spacings of a field would not separate the tissue
// and is made that wide.
struct TearCut {
  static constexpr const char* kType = "tear";
  static constexpr const char* kHelp = "A slot along a path on the surface.";
  std::vector<glm::dvec3> path;
  glm::dvec3 into{0, 0, -1};
  double depth = 2e-3, width = 5e-4, lead = 1e-3;
  friend bool operator==(const TearCut&, const TearCut&) = default;
  template <class V>
  void Visit(V&& v) {
    // A tear is clicked point by point; a path of more points is a mistake.
    v("path", path, Required{PointList{2, 1000, kCoordinate}}, "m", "Points of the path.");
    v("into", into, Required{Direction{kCoordinate}}, "m", "Direction in which the slot is deep.");
    v("depth", depth, Required{kLength}, "m", "Depth of the slot.");
    v("width", width, kLength, "m", "Width of the slot; less than about 0.0005 is made that wide.");
    v("lead", lead, Range{0, 2}, "m", "How far before the path the slot begins.");
  }
};
using Cut = std::variant<CapsuleCut, BoxCut, TearCut>;

// The same in a frame in which everything is `scale` times as large.
Ball Scaled(Ball ball, double scale);
Cut Scaled(Cut cut, double scale);

}  // namespace arthro
