// Living tissue into the views: hands over what changed of each body since the last time, and only
// that.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "app/view/arthroscopic_view.h"
#include "app/view/overview/overview.h"
#include "simulation/scene/scene.h"
#include "simulation/tissue/body/tissue_world.h"

namespace arthro::app {

class LiveTissues {
 public:
  // `overview` may be null. True: something is to be drawn anew.
  bool Show(const simulation::WorldPicture& world, std::span<const Tissue> tissues,
            ArthroscopicView& scope, Overview* overview);
  // Nothing is shown any more: the next world is handed over whole.
  void Forget() { shown_.clear(); }
  bool empty() const { return shown_.empty(); }

 private:
  struct Shown {
    std::shared_ptr<const simulation::BodySkin> skin;
    std::uint64_t shape = 0;
  };
  std::vector<Shown> shown_;
  std::vector<glm::dvec3> unscaled_;  // room
};

}  // namespace arthro::app
