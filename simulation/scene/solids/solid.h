// Solid given by functions: primitives that are joined in the order of a list [paper, 3.4]. A
// tissue names its file (*.solid) where others name a triangle surface. Own frame of the solid, m,
// rad. Each Visit lists the fields of the file once: name, rule, unit, help (core/options.h).
//
// A part joins everything above it in the list. Parts of a higher level are joined with one another
// first; the first of them says how the whole group joins. The level rises by one at a time.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/frames.h"
#include "simulation/scene/limits/scene_limits.h"

namespace arthro {

enum class SolidJoin { kUnion, kIntersection, kDifference };

// Most parts of a solid, and deepest level of a part: a servo tick evaluates all of them.
inline constexpr int kMostSolidParts = 64;
inline constexpr int kDeepestSolidLevel = 7;

// Place of a part, and how it joins what stands above it.
struct SolidPlace {
  SolidJoin join = SolidJoin::kUnion;
  double blend = 0;
  int level = 0;
  Rigid3 solid_from_part = {};
  friend bool operator==(const SolidPlace&, const SolidPlace&) = default;
  template <class V>
  void Visit(V&& v) {
    v("join", join,
      LeftOutAt{SolidJoin::kUnion, Choices<SolidJoin>{{{SolidJoin::kUnion, "union"},
                                                       {SolidJoin::kIntersection, "intersection"},
                                                       {SolidJoin::kDifference, "difference"}}}},
      "", "How it joins what stands above it.");
    v("blend", blend, LeftOutAt{0.0, Range{0, 0.05}}, "m",
      "Width over which the joint is rounded; 0: a sharp edge.");
    v("level", level, LeftOutAt{0, Range{0, kDeepestSolidLevel}}, "",
      "Parts in a row of a higher level are joined with one another first.");
    v("centre", solid_from_part.translation, kCoordinate, "m", "Centre of the part.");
    v("quaternion", solid_from_part.rotation, Any{}, "", "Turns the part about its centre.");
  }
};

struct EllipsoidPart {
  static constexpr const char* kType = "ellipsoid";
  static constexpr const char* kHelp = "An ellipsoid; a ball where its radii are equal.";
  SolidPlace place;
  glm::dvec3 radii{3e-3};
  friend bool operator==(const EllipsoidPart&, const EllipsoidPart&) = default;
  template <class V>
  void Visit(V&& v) {
    place.Visit(v);
    v("radii", radii, Required{kLength}, "m", "Half of its size along its own axes.");
  }
};

struct CapsulePart {
  static constexpr const char* kType = "capsule";
  static constexpr const char* kHelp = "A rod with round ends along its own z axis.";
  SolidPlace place;
  double length = 6e-3, radius = 1.5e-3;
  friend bool operator==(const CapsulePart&, const CapsulePart&) = default;
  template <class V>
  void Visit(V&& v) {
    place.Visit(v);
    v("length", length, Required{kLength}, "m", "Between the centres of its ends.");
    v("radius", radius, Required{kLength}, "m", "Radius of the rod and its ends.");
  }
};

struct TorusPart {
  static constexpr const char* kType = "torus";
  static constexpr const char* kHelp = "A ring about its own z axis.";
  SolidPlace place;
  double ring_radius = 4e-3, tube_radius = 1.2e-3;
  friend bool operator==(const TorusPart&, const TorusPart&) = default;
  template <class V>
  void Visit(V&& v) {
    place.Visit(v);
    v("ring_radius", ring_radius, Required{kLength}, "m", "From the centre to that of the tube.");
    v("tube_radius", tube_radius, Required{kLength}, "m", "Radius of the tube.");
  }
};

struct BoxPart {
  static constexpr const char* kType = "box";
  static constexpr const char* kHelp = "A box, with round edges if so given.";
  SolidPlace place;
  glm::dvec3 half{3e-3};
  double rounding = 0;
  friend bool operator==(const BoxPart&, const BoxPart&) = default;
  template <class V>
  void Visit(V&& v) {
    place.Visit(v);
    v("half", half, Required{kLength}, "m", "Half of its size along its own axes.");
    v("rounding", rounding, LeftOutAt{0.0, Range{0, 0.05}}, "m",
      "Radius of its edges, within the size.");
  }
};

struct PlanePart {
  static constexpr const char* kType = "plane";
  static constexpr const char* kHelp = "Everything below its own z = 0; it must be cut to a size.";
  SolidPlace place;
  friend bool operator==(const PlanePart&, const PlanePart&) = default;
  template <class V>
  void Visit(V&& v) {
    place.Visit(v);
  }
};

using SolidPart = std::variant<EllipsoidPart, CapsulePart, TorusPart, BoxPart, PlanePart>;

struct Solid {
  std::vector<SolidPart> parts;
  friend bool operator==(const Solid&, const Solid&) = default;
  template <class V>
  void Visit(V&& v) {
    v("parts", parts, Required{Any{}}, "", "Parts in the order in which they join.");
  }
};

SolidPlace& PlaceOf(SolidPart& part);
const SolidPlace& PlaceOf(const SolidPart& part);
const char* TypeOf(const SolidPart& part);

// The same with everything `scale` times as large.
Solid Scaled(Solid solid, double scale);

// Says what is wrong with the list of parts, or nothing: no part, too many, a number that is not
// finite or not positive, a level that is skipped, a first part that takes away, a solid without
// end or larger than a joint.
std::string FaultOfSolid(const Solid& solid);

}  // namespace arthro
