// Tears of the usual kinds as cuts of a tissue (tissue_parts.h), found on the surface of a
// meniscus, generated or imported. Places along the crescent are shares of its angle: 0 at the horn
// with the smaller y of the tissue's own frame, which is the anterior one in the library, 1 at the
// other. The kinds are those of the ISAKOS classification; resources/doc/models.md has a row for
// each.
#pragma once

#include <span>
#include <vector>

#include "simulation/core/options.h"
#include "simulation/core/units.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/tissue_parts.h"

namespace arthro::authoring {

enum class TearKind { kLongitudinal, kBucketHandle, kRadial, kFlap, kHorizontal, kRoot };

struct TearOptions {
  explicit TearOptions(TearKind its_kind = TearKind::kLongitudinal);

  TearKind kind;
  double position;   // share of the crescent's angle, middle of the tear
  double length;     // m, along the crescent
  double rim_width;  // m, from the outer rim to a longitudinal tear
  double reach;      // m, from the free edge outwards
  double width = MetresFromMm(0.6);
  double displacement = 0;  // m, of the middle of a bucket handle, towards the notch
  template <class V>
  void Visit(V&& v) {
    v("tear_position", position, Range{0.0, 1.0}, "",
      "Middle of the tear along the crescent: 0 at the end of the anterior horn, 1 at that of the "
      "posterior horn.");
    v("tear_length", length, Range{MetresFromMm(2), MetresFromMm(80)}, "m",
      "Length along the crescent, of a longitudinal, bucket-handle, flap or horizontal tear.");
    v("tear_rim_width", rim_width, Range{MetresFromMm(1), MetresFromMm(12)}, "m",
      "Width of the rim outside of a longitudinal or bucket-handle tear.");
    v("tear_reach", reach, Range{MetresFromMm(1), MetresFromMm(15)}, "m",
      "Reach from the free edge outwards, of a radial, flap or horizontal tear.");
    v("tear_width", width, Range{MetresFromMm(0.3), MetresFromMm(2)}, "m",
      "Width of the open slot at rest.");
    v("tear_displacement", displacement, Range{0, MetresFromMm(12)}, "m",
      "How far the middle of a bucket handle lies from its place, towards the notch; 0: it lies in "
      "its place.");
  }
};

// Word of each kind on the command line, and its title.
struct TearEntry {
  TearKind kind;
  const char* word;
  const char* title;
};
std::span<const TearEntry> TearEntries();

// Throws Error(kBadMesh) where the surface is no crescent, and Error(kBadArgument) where the tear
// does not fit into it.
std::vector<Cut> TearCuts(const SurfaceMesh& surface, const TearOptions& options);

// The surface of a meniscus after its bucket-handle tear, with the handle displaced: the most in
// the middle of the tear, and not at its ends. `torn`: the surface with the slot cut into it;
// `whole`: before. Throws Error(kBadArgument) for another kind of tear, and where the handle has no
// room.
SurfaceMesh WithDisplacedHandle(SurfaceMesh torn, const SurfaceMesh& whole,
                                const TearOptions& options);

}  // namespace arthro::authoring
