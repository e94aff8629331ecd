#include "app/editor/pictures/quiet_work.h"

#include <utility>

#include "simulation/core/error.h"

namespace arthro::app {

void QuietWork::Start(Map depth, Map sigma, const Backdrop& backdrop, const PixelBounds& changed,
                      std::function<void()> wake) {
  Join();
  changed_ = Joined(changed_, changed);
  stop_ = has_ended_ = false;
  result_ = {depth, {}};
  thread_ = std::thread([this, depth = std::move(depth), sigma = std::move(sigma), backdrop,
                         box = changed_, wake = std::move(wake)] {
    try {
      result_.part = simulation::WithoutNoiseAround(*depth, *sigma, backdrop, box, &stop_);
    } catch (const Error&) {
      return;  // stopped
    }
    has_ended_ = true;
    if (wake) wake();
  });
}

void QuietWork::Join() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

void QuietWork::Stop() {
  Join();
  changed_ = {};
}

std::optional<QuietWork::Result> QuietWork::Take() {
  if (!has_ended_ || !thread_.joinable()) return std::nullopt;
  thread_.join();
  changed_ = {};
  return std::exchange(result_, {});
}

}  // namespace arthro::app
