// Functions of solids, which the servo asks for many times per tick, by kind and number of parts.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/bench/micro/micro_bench.h"
#include "simulation/scene/solids/solid_function.h"
#include "simulation/scene/solids/solid_io.h"

namespace arthro::app {
namespace {

constexpr int kQueries = 1000;   // per call
constexpr double kReach = 8e-3;  // m, half side of the cube of the queries

std::vector<glm::dvec3> Places() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> side(-kReach, kReach);
  std::vector<glm::dvec3> places;
  for (int i = 0; i < kQueries; ++i) {
    const double x = side(random), y = side(random), z = side(random);
    places.push_back({x, y, z});
  }
  return places;
}

// Least value over the distance to the nearest vertex of the surface, for places that are further
// off than 1 mm: 1 where the value is the distance.
MicroError LeastShare(const Solid& solid, const SolidFunction& function) {
  const SurfaceMesh surface = SurfaceOfSolid(solid, 96);
  double share = 1;
  for (const glm::dvec3& x : Places()) {
    double least = 1;
    for (const glm::dvec3& vertex : surface.vertices)
      least = std::min(least, glm::distance(x, vertex));
    if (least > 1e-3) share = std::min(share, std::abs(function.Value(x)) / least);
  }
  return {1 - share, fmt::format("{:.3f}", 1 - share)};
}

void Add(MicroGroup& group, const std::string& name, const Solid& solid) {
  const SolidFunction function(solid);
  const std::vector<glm::dvec3> places = Places();
  group.functions.push_back({name + ", 1000 values",
                             [=] {
                               for (const glm::dvec3& x : places) KeepAlive(function.Value(x));
                             },
                             [=] { return LeastShare(solid, function); }});
  group.functions.push_back({name + ", 1000 normals",
                             [=] {
                               for (const glm::dvec3& x : places) KeepAlive(function.Normal(x));
                             },
                             {}});
}

// A row of balls, each taken from or united with those before it.
Solid Row(int count) {
  Solid solid;
  for (int i = 0; i < count; ++i) {
    EllipsoidPart ball;
    ball.radii = {2e-3, 1.5e-3, 1e-3};
    ball.place.solid_from_part.translation.x = 8e-3 * i / count - 4e-3;
    ball.place.blend = 5e-4;
    if (i % 3 == 2) ball.place.join = SolidJoin::kDifference;
    solid.parts.push_back(ball);
  }
  return solid;
}

}  // namespace

MicroGroup SolidMicro(bool quick) {
  MicroGroup group{"solid",
                   "share of the distance that the value falls short of, beyond 1 mm",
                   "nearest vertex of a fine surface",
                   {}};
  Add(group, "ball", {{EllipsoidPart{{}, glm::dvec3(3e-3)}}});
  Add(group, "flat ellipsoid", {{EllipsoidPart{{}, {5e-3, 2e-3, 1e-3}}}});
  if (quick) return group;
  Add(group, "capsule", {{CapsulePart{}}});
  Add(group, "torus", {{TorusPart{}}});
  Add(group, "box", {{BoxPart{}}});
  for (const int count : {2, 8, kMostSolidParts})
    Add(group, fmt::format("{} blended ellipsoids", count), Row(count));
  return group;
}

}  // namespace arthro::app
