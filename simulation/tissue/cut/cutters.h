// Shapes that remove tissue, as signed distances (negative inside the tool): the bite of a basket
// punch, the window of a shaver, a tear along a path. An author's cut is a plain value
// (tissue_parts.h). Undo cuts the original again with one cut less, and a session's reset applies
// all of them. Field's frame, m, m³, s.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/options.h"
#include "simulation/scene/tissue_parts.h"
#include "simulation/tissue/field/pieces.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

double DistanceToCapsule(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b,
                         double radius) noexcept;

// Throws Error(kBadArgument) for a cut without extent or that is not finite.
void CheckCut(const Cut& cut);
double DistanceTo(const Cut& cut, const glm::dvec3& x) noexcept;
// Returns the box of all points nearer than `margin` to the cut.
Box3 BoundsOf(const Cut& cut, double margin);

// Checks the cut and removes it from the field.
FieldEdit Apply(SolidField& field, const Cut& cut);
// Returns the original with all of these cuts; undo leaves out the last one.
SolidField CutAll(const SolidField& original, std::span<const Cut> cuts);

// Maps a rest position to its present place. It must extend a few spacings beyond the surface (an
// element's weights, extrapolated). Returns false far from the tissue and then leaves `place`
// alone.
using Deformation = std::function<bool(const glm::dvec3& rest, glm::dvec3& place)>;
using ToolDistance = std::function<double(const glm::dvec3& place)>;

// Removes the points of a box at rest whose present place is inside the tool.
FieldEdit SubtractDeformed(SolidField& field, const Box3& rest_box, const Deformation& deformation,
                           const ToolDistance& distance);

struct ShaverOptions {
  double rate = 30e-9;
  template <class V>
  void Visit(V&& v) {
    v("shaver_rate", rate, Range{1e-12, 1e-6}, "m3/s",
      "Tissue volume that a running shaver removes while its window is full.");
  }
};
// Volume that a shaver may still remove: it grows with running time and shrinks with the removed
// volume.
struct Shaver {
  double allowance = 0;  // m³
};
// Does one step of a running shaver. The mean does not exceed the rate: an excess of one step is
// subtracted from the next ones.
FieldEdit Shave(SolidField& field, const Box3& rest_box, const Deformation& deformation,
                const ToolDistance& distance, const ShaverOptions& options, double dt,
                Shaver& shaver);

struct RegionVolume {
  std::string name;
  double removed = 0;  // m³
};
// Returns the volume removed from `original` per region. A cell in several regions counts for the
// first, a cell in none for the last entry, "elsewhere". The sum is the difference of the volumes.
// Throws Error(kBadArgument) unless both fields have the same grid.
std::vector<RegionVolume> RemovedByRegion(const SolidField& original, const SolidField& now,
                                          std::span<const Region> regions);
// Returns the solid volume per region in m³, and that elsewhere as the last entry, by the same
// rule.
std::vector<double> VolumeByRegion(const SolidField& field, std::span<const Region> regions);

// Largest volume of a loose fragment that is washed away: the largest that passes the window of a
// 4.5 mm shaver.
inline constexpr double kDebrisVolume = 60e-9;  // m³

// Removes small loose fragments; none if nothing holds the tissue (`fixed` empty).
CrumbReport RemoveDebris(SolidField& field, std::span<const Ball> fixed);

// Result of the author's cuts, after which small loose fragments are removed as after a bite.
struct MadeCuts {
  std::vector<double> removed;  // m³ per cut: volume removed beyond that of the cuts before it
  CrumbReport washed;
  Box3 changed = kEmptyBox;
};
// Throws Error(kBadArgument) for an invalid cut and Error(kBadScene) if nothing is left.
MadeCuts MakeCuts(SolidField& field, std::span<const Cut> cuts, std::span<const Ball> fixed);

}  // namespace arthro::simulation
