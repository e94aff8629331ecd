// What takes tissue away, as signed distances (negative inside the tool): the basket punch's bite,
// the shaver's window, a tear along a path. An author's cut is a plain value (tissue_parts.h), so
// that undo is cutting the original again with one value less, and a session's reset is the
// original with all of them. Field's own frame, m, m³, s.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/options.h"
#include "simulation/scene/tissue_parts.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

double DistanceToCapsule(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b,
                         double radius) noexcept;

// Throws Error(kBadArgument) for a cut without extent or that is not finite.
void CheckCut(const Cut& cut);
double DistanceTo(const Cut& cut, const glm::dvec3& x) noexcept;
// Of all that is nearer than `margin` to the cut.
Box3 BoundsOf(const Cut& cut, double margin);

// Takes the cut away; checked first.
FieldEdit Apply(SolidField& field, const Cut& cut);
// The original with all of these cuts; undo leaves out the last.
SolidField CutAll(const SolidField& original, std::span<const Cut> cuts);

// Where a rest position is now. It must go on a few spacings past the surface (an element's
// weights, extrapolated); false: nowhere near, left alone.
using Deformation = std::function<bool(const glm::dvec3& rest, glm::dvec3& place)>;
using ToolDistance = std::function<double(const glm::dvec3& place)>;

// Takes away, within a box at rest, what is inside the tool where the tissue is now.
FieldEdit SubtractDeformed(SolidField& field, const Box3& rest_box, const Deformation& deformation,
                           const ToolDistance& distance);

struct ShaverOptions {
  double rate = 30e-9;
  template <class V>
  void Visit(V&& v) {
    v("shaver_rate", rate, Range{1e-12, 1e-6}, "m3/s",
      "Tissue that a running shaver takes away while its window is full.");
  }
};
// What a shaver may still take: grows with time while it runs, shrinks with what it took.
struct Shaver {
  double allowance = 0;  // m³
};
// One step of a running shaver. In the mean it takes no more than the rate: what a step took too
// much by is taken from the next ones.
FieldEdit Shave(SolidField& field, const Box3& rest_box, const Deformation& deformation,
                const ToolDistance& distance, const ShaverOptions& options, double dt,
                Shaver& shaver);

struct RegionVolume {
  std::string name;
  double removed = 0;  // m³
};
// What was taken from `original`, by region; a cell that lies in several counts for the first, one
// in none for the last entry, "elsewhere". The sum is the difference of the volumes. Both fields
// must have one grid: Error(kBadArgument).
std::vector<RegionVolume> RemovedByRegion(const SolidField& original, const SolidField& now,
                                          std::span<const Region> regions);

}  // namespace arthro::simulation
