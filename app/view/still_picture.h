// Single pictures of a scene without a window, for the jobs `view` and `demo` and for tests. The
// same scene and picture give the same bytes in every run.
#pragma once

#include <optional>
#include <string>

#include "app/view/arthroscopic_view.h"
#include "app/view/offscreen_context.h"
#include "simulation/practice/scope_eye.h"
#include "simulation/practice/snapshot.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/scope/camera_head.h"
#include "simulation/scope/rod_pose.h"

namespace arthro::app {

// Returns the frame of a held scope. Without a head roll the camera head turns with the scope.
Picture PictureFromPose(const simulation::RodPose& pose, double view_angle, double field_of_view,
                        std::optional<double> head_roll = std::nullopt);

// Picture of a moment of a session from the eye of the scope (simulation/practice/scope_eye.h),
// with the instrument where its proxy is.
Picture PictureOf(const simulation::Snapshot& snapshot, const simulation::RodPose& seen_from,
                  simulation::ToolKind kind, const Scene& scene, double view_angle,
                  const simulation::ScopeOptics& optics, const simulation::CameraHead& head);

class StillPictures {
 public:
  static constexpr int kMinSize = 16, kMaxSize = 4096;  // px

  // Throws Error(kDisplay) when nothing can draw, and Error for an author's cut that cannot be
  // made. Copies `loaded` to the renderer. `looks`: one per tissue, or none.
  explicit StillPictures(const LoadedScene& loaded,
                         std::span<const simulation::TissueLook> looks = {});

  // Draws four rays per pixel: twice as large, then averaged. Throws Error(kBadArgument) for a tip
  // outside the backdrop's sphere, where there is nothing to see, and for a size out of range.
  ColourImage Draw(const Picture& picture, int size);

  // Returns the pose of the rod to the scope's eye for a scope that enters to `pose`. Throws
  // Error(kBadArgument) for a tip outside the backdrop's sphere.
  simulation::RodPose Hold(const simulation::RodPose& pose);
  // Eye of the scope for pictures that follow one another.
  simulation::ScopeEye& eye();

  ArthroscopicView& view() { return view_; }
  const OffscreenContext& context() const { return context_; }

 private:
  OffscreenContext context_;
  ArthroscopicView view_;  // after the context, so that it is destroyed first
  LoadedScene loaded_;
  std::optional<simulation::ScopeEye> eye_;  // made when it is first used
};

}  // namespace arthro::app
