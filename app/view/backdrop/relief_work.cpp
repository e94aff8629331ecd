#include "app/view/backdrop/relief_work.h"

#include <chrono>
#include <utility>

#include "simulation/scene/files/loaded_scene.h"

namespace arthro::app {
namespace {

using Source = ReliefWork::Source;

ReliefMaps MapsOf(const Source& source) { return {OrEmpty(source.depth), OrEmpty(source.sigma)}; }

// `made`: relief of `before`; null: there is none.
DrawnRelief Make(const Source& source, const Source& before, const DrawnRelief* made,
                 const std::atomic<bool>* stop) {
  const bool is_same_place =
      before.panorama_size == source.panorama_size && before.backdrop == source.backdrop;
  if (made != nullptr && is_same_place)
    if (const auto changed = SmallChange(MapsOf(before), MapsOf(source)))
      return WithChange(*made, source.panorama_size, MapsOf(source), source.backdrop, *changed,
                        stop);
  return MakeDrawnRelief(source.panorama_size, OrEmpty(source.depth), OrEmpty(source.sigma),
                         source.backdrop, ReliefNoise::kRemoved, stop);
}

}  // namespace

std::shared_ptr<const DrawnRelief> ReliefWork::Find(const Source& source) {
  if (made_ && source_ == source) return made_;
  if (busy()) return nullptr;
  wanted_ = source;
  work_ = std::async(std::launch::async, [source, before = source_, made = made_, stop = &stop_] {
    return Make(source, before, made.get(), stop);
  });
  return nullptr;
}

bool ReliefWork::Collect() {
  if (!busy() || work_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
  made_ = std::make_shared<const DrawnRelief>(work_.get());
  source_ = std::exchange(wanted_, {});
  return true;
}

}  // namespace arthro::app
