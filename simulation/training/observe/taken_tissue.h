// Tissue that was taken in an attempt: volume in the regions of the targets and outside of them,
// what is left to the wall that holds the tissue, and how well the cut follows the regions' spheres
// [method.md, Metrics]. A reset of the tissue puts nothing back that was taken outside.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "simulation/scene/files/loaded_scene.h"
#include "simulation/scene/mesh/surface_finder.h"
#include "simulation/tissue/body/tissue_world.h"
#include "simulation/training/observe/attempt_frame.h"
#include "simulation/training/observe/target_place.h"

namespace arthro::simulation {

// Distance from the balls that hold a tissue within which its skin is the wall.
inline constexpr double kWallReach = 3e-3;  // m

class TakenTissue {
 public:
  TakenTissue(const LoadedScene& loaded, std::span<const TargetPlace> targets);

  // Sets what was taken since the frame before, and the shares, rim and contour of now. Frames come
  // in their order; frame.sight has its targets. `world`: present tissues; null: none deforms.
  void Measure(const WorldPicture* world, AttemptFrame& frame);

 private:
  struct Target {
    int tissue = -1;
    std::vector<int> regions;
  };
  // Tissue with regions that are to be removed. Frame of its body, m.
  struct Trimmed {
    int tissue = -1;
    std::unique_ptr<SurfaceFinder> wall;  // null: nothing holds it
    std::vector<Ball> regions;            // those of the targets
    std::shared_ptr<const BodySkin> skin;
    double rim = -1;           // m; −1: nothing was cut
    double squares = 0;        // m², of the distances from the spheres
    std::size_t vertices = 0;  // vertices on cut faces
  };
  static void MeasureFaces(const std::shared_ptr<const BodySkin>& skin, Trimmed& trimmed);

  std::vector<Target> targets_;
  std::vector<Trimmed> trimmed_;
  double removed_ = 0, outside_ = 0;  // m³ at the frame before
};

}  // namespace arthro::simulation
