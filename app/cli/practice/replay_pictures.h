// A replay as rows of pictures, each at a constant rate: what the trainee saw, tissue and all.
// Picture i of a row is of the tick at t = begin + i/rate, or the next one, which is a millisecond
// away at most, so that the same trace gives the same pictures. It stands for [t, t + 1/rate), so
// that a film of them lasts as long as the trace.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "app/recording/frame_shape.h"
#include "app/view/live_tissues.h"
#include "app/view/still_picture.h"
#include "simulation/practice/replay/replay.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scope/camera_head.h"

namespace arthro::app {

class ReplayPictures {
 public:
  using Take = std::function<void(const ColourImage&)>;
  struct Form {
    FrameShape shape = FrameShape::kSquare;
    int size = 512;      // px, height
    double rate = 30.0;  // a second
  };

  // Camera head and disturbances; nullopt: as they were recorded.
  struct Wish {
    std::optional<simulation::CameraHead> head;
    std::optional<Disturbances> disturbances;
    bool has_flecks = true;  // the fluid of the scene moves them
  };

  // Trace from `begin` to `end`, s. Villi and disturbances that move do so by its time.
  ReplayPictures(const LoadedScene& loaded, double begin, double end, const Wish& wish,
                 std::span<const simulation::TissueLook> looks)
      : scene_(loaded.scene),
        optics_(simulation::OpticsOf(loaded.scene.scope, loaded.lens)),
        wish_(wish),
        begin_(begin),
        end_(end),
        pictures_(loaded, looks) {}

  void AddRow(const Form& form, Take take);
  void Watch(double t, const simulation::Snapshot& snapshot, const simulation::WorldPicture* world);

 private:
  struct Row {
    Form form;
    Take take;
    int count = 0, all = 0;
  };
  const Scene& scene_;
  simulation::ScopeOptics optics_;
  Wish wish_;
  double begin_, end_;
  StillPictures pictures_;
  LiveTissues tissues_;
  std::vector<Row> rows_;
};

// Writes frame_00000.png and on into a folder that exists. Throws Error(kFile).
ReplayPictures::Take IntoFolder(const std::filesystem::path& folder);

// Picture of a recorded moment; without the instrument while its device has a fault.
Picture RecordedPicture(const simulation::Snapshot& snapshot, const simulation::RodPose& seen_from,
                        const simulation::ScopeOptics& optics, const simulation::CameraHead& head);

}  // namespace arthro::app
