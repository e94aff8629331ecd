// Faults of a surface with all their places, so that they can be drawn on it, and the repairs that
// need no guess about its shape. Places in the surface's own frame, m.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/progress.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::authoring {

enum class FaultKind {
  kUntidy,     // copies of triangles, triangles without area, neighbours that face opposite ways
  kHole,       // small opening of a surface that is closed otherwise
  kSheet,      // rim of a surface that is open as a whole, as scans of cartilage are
  kBranching,  // more than two triangles at an edge
  kCrossing,   // the surface runs through itself
  kSliver      // triangles with an angle below kSliverAngle
};

struct SurfaceFault {
  FaultKind kind = FaultKind::kUntidy;
  int count = 0;
  std::vector<std::array<glm::dvec3, 2>> edges;      // m, to be drawn
  std::vector<std::array<glm::dvec3, 3>> triangles;  // m, to be filled
  std::string sentence;                              // the fault, and what mends it or why nothing
};

struct SurfaceFaults {
  std::vector<SurfaceFault> faults;  // one per kind that was found, in the order of FaultKind
  bool Has(FaultKind kind) const;
  bool CanBeMended() const { return Has(FaultKind::kUntidy) || Has(FaultKind::kHole); }
};

inline constexpr double kSliverAngle = 0.034906585039886592;  // rad, 2 degrees
// A larger opening is the rim of a sheet: what filled it would be shape that nobody measured.
inline constexpr double kMostHoleShare = 0.01;  // share of the surface's area

SurfaceFaults FindSurfaceFaults(const SurfaceMesh& surface, const Progress& progress = {});

// Welds vertices, drops copies, turns triangles that face the wrong way, and fills small holes.
// `what` gets the changes in words. Throws Error(kBadMesh) where a filled hole would run through
// the surface.
SurfaceMesh MendSurface(const SurfaceMesh& surface, std::string* what,
                        const Progress& progress = {});

// The same, then gives each open sheet a back at `thickness` behind its triangles, before them when
// negative. Throws Error(kBadMesh) where the layer would run through itself.
SurfaceMesh MakeLayer(const SurfaceMesh& surface, double thickness, const Progress& progress = {});

}  // namespace arthro::authoring
