// Cross-sections of a crescent's surface by half-planes through its axis, which know nothing of how
// the surface was made: generated models and imported ones are measured and torn alike. m, rad.
#pragma once

#include "simulation/core/frames.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::authoring {

// Extent of a section: radii about the axis, and heights along it.
struct CrescentSection {
  bool is_empty = true;
  double inner = 0, outer = 0, low = 0, high = 0;
};

class CrescentSections {
 public:
  // The axis is z of the crescent's frame; the angle 0 is its x.
  CrescentSections(const SurfaceMesh& surface, const Rigid3& model_from_crescent);

  CrescentSection At(double angle) const;
  // Heights of the section at one radius; empty where the surface is not met.
  CrescentSection At(double angle, double radius) const;
  // Length of the outer or the inner border between two angles.
  double BorderLength(double from, double to, bool is_outer) const;
  glm::dvec3 Place(double angle, double radius, double height) const;
  // A place of the model in the crescent's frame.
  glm::dvec3 InCrescent(const glm::dvec3& x_in_model) const;

 private:
  SurfaceMesh local_;  // in the crescent's frame
  Rigid3 model_from_crescent_;
};

}  // namespace arthro::authoring
