#include "app/view/backdrop/relief_work.h"

#include <chrono>

#include "simulation/scene/files/loaded_scene.h"

namespace arthro::app {

std::shared_ptr<const DrawnRelief> ReliefWork::Find(const Source& source) {
  if (busy()) return nullptr;
  if (made_ && source_ == source) return made_;
  made_.reset();
  source_ = source;
  work_ = std::async(std::launch::async, [source] {
    return MakeDrawnRelief(source.panorama_size, OrEmpty(source.depth), OrEmpty(source.sigma),
                           source.backdrop);
  });
  return nullptr;
}

bool ReliefWork::Collect() {
  if (!busy() || work_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
  made_ = std::make_shared<const DrawnRelief>(work_.get());
  return true;
}

}  // namespace arthro::app
