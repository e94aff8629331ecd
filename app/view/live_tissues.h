// Hands over to the views what changed of each simulated body since the last call. What hardly
// moves stays as it is drawn (settling.h).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/view/arthroscopic_view.h"
#include "app/view/overview/overview.h"
#include "simulation/scene/scene.h"
#include "simulation/tissue/body/tissue_world.h"

namespace arthro::app {

class LiveTissues {
 public:
  // `overview` may be null. Returns true when a view must be drawn again.
  bool Show(const simulation::WorldPicture& world, std::span<const Tissue> tissues,
            ArthroscopicView& scope, Overview* overview);
  // Returns the instrument as it is drawn in the frame after the last one.
  InstrumentView Settled(InstrumentView tool);
  // Forgets what is shown: the next world is handed over completely.
  void Forget() {
    shown_.clear();
    tool_.reset();
  }
  bool empty() const { return shown_.empty(); }

 private:
  struct Shown {
    std::shared_ptr<const simulation::BodySkin> skin;
    std::uint64_t shape = 0;
    std::vector<glm::dvec3> places{}, normals{};  // drawn
    bool has_settled = false;
  };
  std::vector<Shown> shown_;
  std::vector<glm::dvec3> unscaled_;  // reused memory
  std::optional<InstrumentView> tool_;
};

}  // namespace arthro::app
