// Contact model of the backdrop [paper, 3.4; method.md, Backdrop]: the sphere of radius D about the
// scope portal with the depth map h as relief. Free space is inside:
//   c(x) = (D − h(π(x))) − |x| > 0,   ∇c = −(h_u ∇u + h_v ∇v) − x/|x|,
//   clearance = c/|∇c| (distance to first order),   normal = ∇c/|∇c| (into free space)
// Built once: the relief is smoothed over imaged pixels only, the wider the larger its standard
// error is (relief_smoothing.h), and its central differences h_u, h_v are stored. All are
// interpolated bilinearly, so the normal is continuous. A weight fades to 0 towards holes (NaN) and
// borders, where the surface is unknown, and is lower where its standard error is large. Portal
// frame, m. Query is noexcept, allocates nothing.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/options.h"
#include "simulation/scene/image.h"
#include "simulation/scene/scene.h"

namespace arthro::simulation {

struct DepthFieldOptions {
  // One pass blurs by σ² = ½ px². Two passes remove noise of single pixels, and keep the normal of
  // a relief with slopes of 1 over 0.05 mm pixels within 0.1°.
  int smoothing_passes = 2;
  // A quantised map, as from 8-bit depth, needs more passes, or the force jumps at each step
  // [method.md, Backdrop force].
  int quantised_passes = 24;
  double fade_px = 8.0;  // wide enough that K·1 mm fades by less than 0.1 N per pixel
  // A force turns by less than the 0.3 rad at which a hand feels another direction, for three
  // standard deviations of the noise.
  double noise_slope = 0.1;
  double widest_smoothing = 5e-3;  // m; wider than a standard error of 1.4 mm asks for
  double soft_error = 1e-3;        // m; an error σ changes the force by less than K·1 mm, 0.5 N
  template <class V>
  void Visit(V&& v) {
    v("smoothing_passes", smoothing_passes, Range{0, 30}, "",
      "Binomial 3x3 passes over the depth map before contact is computed.");
    v("quantised_passes", quantised_passes, Range{0, 100}, "",
      "Binomial 3x3 passes over a quantised depth map, as one from 8-bit grey.");
    v("fade_px", fade_px, Range{1, 64}, "px",
      "The force fades over this many pixels towards holes and borders of the depth map.");
    v("noise_slope", noise_slope, Range{0.01, 1}, "",
      "Slope, rms, that noise of the standard error of the depth map may have.");
    v("widest_smoothing", widest_smoothing, Range{0, 0.02}, "m",
      "Widest smoothing of a depth map with a standard error, as a standard deviation.");
    v("soft_error", soft_error, Range{1e-5, 1}, "m",
      "Standard error of the depth map that halves the stiffness.");
  }
};

// Quantisation step of a depth map, m; 0 for a smooth one.
double QuantumOf(const DepthMap& depth);

// Result of a query at a point. weight 0: there is no surface.
struct FieldQuery {
  double clearance = 0;         // m, negative below the surface
  glm::dvec3 normal{0, 0, -1};  // unit, into free space
  double weight = 0;            // 0..1
  double px_per_m = 0;  // largest motion of the pixel per motion of x; 0 where there is no pixel
};

class DepthField {
 public:
  DepthField() = default;  // no surface
  // Bare sphere, over the area of a picture of width x height.
  DepthField(const Backdrop& backdrop, int width, int height,
             const DepthFieldOptions& options = {});
  // `sigma`: standard error of `depth`, m, of its size; empty: not known.
  DepthField(const Backdrop& backdrop, const DepthMap& depth, const DepthFieldOptions& options = {},
             const DepthMap& sigma = {});

  FieldQuery Query(const glm::dvec3& x_in_portal) const noexcept;

  bool empty() const { return width_ == 0; }
  // Radius about the portal within which there is no contact; 1e300 where there is no field.
  double free_radius() const { return free_radius_; }
  // m, size of a pixel on the sphere at the centre of the picture.
  double pixel_size() const { return pixel_size_; }

 private:
  // Keeps the four values of a pixel in one cache line.
  struct Texel {
    float h, hu, hv, weight;
  };
  Texel Sample(double u, double v) const noexcept;

  Projection projection_;
  double radius_ = 0, free_radius_ = 1e300, pixel_size_ = 1e-4, fade_px_ = 8;
  int width_ = 0, height_ = 0;
  std::vector<Texel> texels_;  // empty: the bare sphere
};

}  // namespace arthro::simulation
