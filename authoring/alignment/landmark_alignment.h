// Pose of a tissue from landmarks: points of its model paired with points of the scene. Rigid or
// with one scale. Poses of triples of pairs start a robust fit with a Cauchy loss (Ceres), so that
// a wrong pair is found and named [method.md, Alignment]. Model points in the tissue's own frame,
// scene points in the portal frame, m.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "authoring/alignment/scene_point.h"
#include "simulation/core/frames.h"
#include "simulation/core/options.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::authoring {

struct LandmarkPair {
  std::string name;
  glm::dvec3 x_in_tissue{0.0};  // m
  ScenePoint scene;
  bool is_left_out = false;  // the author excluded it
  friend bool operator==(const LandmarkPair&, const LandmarkPair&) = default;
};

enum class AlignScale { kKeep, kSolve };

struct LandmarkOptions {
  AlignScale scale = AlignScale::kKeep;
  double model_sigma = 2e-4;
  double outlier = 4.0;
  template <class V>
  void Visit(V&& v) {
    v("scale", scale,
      Choices<AlignScale>{{{AlignScale::kKeep, "keep"}, {AlignScale::kSolve, "solve"}}}, "",
      "Keep the scale of the tissue, or solve for it as well.");
    v("model_sigma", model_sigma, Range{0, 0.01}, "m",
      "Standard error of a landmark that was clicked on the model.");
    v("outlier", outlier, Range{2, 20}, "",
      "A pair that is off by more than this many of its standard errors is wrong.");
  }
};

enum class AlignVerdict {
  kAligned,
  kTooFew,       // fewer than three pairs
  kCollinear,    // the turn about a line is not known
  kInconsistent  // no three pairs and a majority agree
};
const char* ToString(AlignVerdict verdict);

struct LandmarkResidual {
  double distance = 0;       // m
  std::optional<double> px;  // in the picture in which it was clicked
  double sigmas = 0;         // in standard errors of the pair
  bool is_used = false;      // neither left out nor found to be wrong
  bool is_wrong = false;     // found to be wrong
};

struct LandmarkAlignment {
  AlignVerdict verdict = AlignVerdict::kTooFew;
  std::string sentence;  // result, or why there is none
  Pose portal_from_tissue;
  std::vector<LandmarkResidual> residuals;  // one per pair
  double rms = 0;                           // m, of the pairs in use
  // Predicted standard errors: of the position of the model's middle, of the rotation and about its
  // least certain axis, and of the scale as a ratio.
  double position_sigma = 0, rotation_sigma = 0, worst_rotation_sigma = 0, scale_sigma = 0;
  int iterations = 0, candidates = 0;
  std::vector<std::string> warnings;
  bool is_aligned() const { return verdict == AlignVerdict::kAligned; }
};

// `present`: pose of the tissue, whose scale is kept or begins the solution. `model`: its surface;
// the middle of its box is where the standard error of the position is stated.
LandmarkAlignment AlignLandmarks(std::span<const LandmarkPair> pairs, const Pose& present,
                                 const SurfaceMesh& model, const LandmarkOptions& options = {});

// Standard deviations of the model points along their principal axes, largest first; m.
glm::dvec3 SpreadOf(std::span<const glm::dvec3> points);
// Whether the points are too near to one line, or to one point, for a turn about it to be known.
bool IsOnLine(std::span<const glm::dvec3> points);

// Sentences on wrong pairs, collinear or clustered landmarks, ranges that are guessed, pairs that
// nothing checks, and the two that contradict each other most where no pose fits. Fills `warnings`
// and `sentence` of a result that is complete otherwise. `kept_scale`: nothing where it was solved.
void DescribeAlignment(std::span<const LandmarkPair> pairs, double model_size,
                       std::optional<double> kept_scale, LandmarkAlignment& alignment);

}  // namespace arthro::authoring
