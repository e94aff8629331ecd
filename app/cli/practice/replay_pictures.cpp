#include "app/cli/practice/replay_pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "simulation/practice/hands/blade_speed.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {

void ReplayPictures::AddRow(const Form& form, Take take) {
  const double count = std::ceil((end_ - begin_) * form.rate - 1e-6);
  rows_.push_back({form, std::move(take), 0, std::max(1, static_cast<int>(count))});
}

void ReplayPictures::Watch(double t, const simulation::Snapshot& snapshot,
                           const simulation::WorldPicture* world) {
  for (Row& row : rows_)
    while (row.count < row.all && t >= begin_ + row.count / row.form.rate - 1e-9) {
      if (world != nullptr) {
        tissues_.Show(*world, scene_.tissues, pictures_.view(), nullptr);
        pictures_.eye().Follow(*world);
      }
      Picture picture = RecordedPicture(snapshot, pictures_.eye().MoveTo(snapshot.scope), optics_,
                                        wish_.head.value_or(snapshot.head));
      if (picture.instrument) picture.instrument = tissues_.Settled(*picture.instrument);
      picture.disturbances = wish_.disturbances.value_or(snapshot.disturbances);
      picture.disturbances.time += t - begin_;
      if (wish_.has_flecks) picture.flecks = FlecksIn(scene_.backdrop);
      row.take(LaidOut(pictures_.Draw(picture, row.form.size), row.form.shape));
      ++row.count;
    }
}

ReplayPictures::Take IntoFolder(const std::filesystem::path& folder) {
  return [folder, count = 0](const ColourImage& picture) mutable {
    WriteColourImage(folder / fmt::format("frame_{:05}.png", count++), picture);
  };
}

Picture RecordedPicture(const simulation::Snapshot& snapshot, const simulation::RodPose& seen_from,
                        const simulation::ScopeOptics& optics, const simulation::CameraHead& head) {
  Picture picture = PictureOf(snapshot, seen_from, snapshot.kind, optics, head);
  if (snapshot.instrument.is_running)
    picture.instrument->turn = simulation::kBladeSpeed * snapshot.t;
  if (snapshot.instrument.fault != simulation::Fault::kNone) picture.instrument.reset();
  return picture;
}

}  // namespace arthro::app
