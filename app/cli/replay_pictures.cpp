#include "app/cli/replay_pictures.h"

#include <utility>

#include <fmt/format.h>

#include "simulation/core/error.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {

ReplayPictures::ReplayPictures(const LoadedScene& loaded, std::filesystem::path folder, int size,
                               double rate)
    : scene_(loaded.scene),
      folder_(std::move(folder)),
      size_(size),
      period_(1.0 / rate),
      pictures_(loaded) {
  std::error_code fault;
  std::filesystem::create_directories(folder_, fault);
  if (fault)
    throw Error(Code::kFile,
                "this folder could not be made: " + fault.message() + "; choose another", folder_);
}

void ReplayPictures::Watch(double t, const simulation::Snapshot& snapshot,
                           simulation::ToolKind kind, const simulation::WorldPicture* world) {
  if (count_ == 0) begin_ = t;
  if (t < begin_ + count_ * period_ - 1e-9) return;
  if (world != nullptr) tissues_.Show(*world, scene_.tissues, pictures_.view(), nullptr);
  WriteColourImage(folder_ / fmt::format("frame_{:05}.png", count_),
                   pictures_.Draw(PictureOf(snapshot, kind, scene_), size_));
  ++count_;
}

Picture PictureOf(const simulation::Snapshot& snapshot, simulation::ToolKind kind,
                  const Scene& scene) {
  Picture picture =
      PictureFromPose(snapshot.scope.pose, scene.scope.view_angle, scene.scope.field_of_view, 0.0);
  if (snapshot.instrument.fault != simulation::Fault::kNone) return picture;
  picture.instrument = InstrumentView{{scene.portals.incision_spacing, 0.0, 0.0},
                                      snapshot.instrument.proxy_in_portal,
                                      snapshot.instrument.pose.roll,
                                      kind,
                                      snapshot.instrument.opening};
  return picture;
}

}  // namespace arthro::app
