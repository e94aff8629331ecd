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
                         source.backdrop, NoiseRemoval::kWhole, stop);
}

}  // namespace

std::shared_ptr<const DrawnRelief> ReliefWork::Slot::Find(
    const Source& asked, const std::function<std::shared_ptr<const DrawnRelief>()>& make) {
  if (source == asked) return made;
  if (work.valid()) return nullptr;
  wanted = asked;
  work = std::async(std::launch::async, make);
  return nullptr;
}

bool ReliefWork::Slot::Collect() {
  if (!work.valid() || work.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return false;
  made = work.get();
  source = std::exchange(wanted, {});
  return true;
}

std::shared_ptr<const DrawnRelief> ReliefWork::Find(const Source& source) {
  return quiet_.Find(source, [source, before = quiet_.source, made = quiet_.made, stop = &stop_] {
    return std::make_shared<const DrawnRelief>(Make(source, before, made.get(), stop));
  });
}

std::shared_ptr<const DrawnRelief> ReliefWork::FindShifted(
    const Source& source, const Source& before, const std::shared_ptr<const DrawnRelief>& made) {
  return shifted_.Find(source, [source, before, made]() -> std::shared_ptr<const DrawnRelief> {
    const auto changed = SmallChange(MapsOf(before), MapsOf(source));
    if (!changed) return nullptr;
    return std::make_shared<const DrawnRelief>(WithShift(
        *made, source.panorama_size, MapsOf(before), MapsOf(source), source.backdrop, *changed));
  });
}

bool ReliefWork::Collect() {
  const bool is_shifted = shifted_.Collect(), is_quiet = quiet_.Collect();
  if (quiet_.source == shifted_.source) shifted_.made = nullptr;  // it is not asked for any more
  return is_shifted || is_quiet;
}

}  // namespace arthro::app
