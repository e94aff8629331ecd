// A replay as a row of pictures, frame_00000.png and on: what the trainee saw, tissue and all.
#pragma once

#include <filesystem>
#include <string>

#include "app/view/live_tissues.h"
#include "app/view/still_picture.h"
#include "simulation/scene/scene_io.h"
#include "simulation/session/replay.h"

namespace arthro::app {

class ReplayPictures {
 public:
  // Makes the folder. `size` px a side, `rate` pictures a second. Throws Error.
  ReplayPictures(const LoadedScene& loaded, std::filesystem::path folder, int size, double rate);

  void Watch(double t, const simulation::Snapshot& snapshot, simulation::ToolKind kind,
             const simulation::WorldPicture* world);
  int count() const { return count_; }

 private:
  const Scene& scene_;
  std::filesystem::path folder_;
  int size_, count_ = 0;
  double period_, begin_ = 0;
  StillPictures pictures_;
  LiveTissues tissues_;
};

// What the view shows of a moment: the camera head is held upright, as surgeons do, while the scope
// turns in it.
Picture PictureOf(const simulation::Snapshot& snapshot, simulation::ToolKind kind,
                  const Scene& scene);

}  // namespace arthro::app
