// Removes the noise of a depth map around a change in a thread of its own: at 4096 px and with much
// noise that takes seconds. The window shows the change at once, and its noise goes when this ends.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include "simulation/haptics/relief/relief_smoothing.h"

namespace arthro::app {

class QuietWork {
 public:
  using Map = std::shared_ptr<const DepthMap>;
  struct Result {
    Map depth;  // the map that it belongs to
    simulation::QuietPart part;
  };

  QuietWork() = default;
  ~QuietWork() { Stop(); }
  QuietWork(const QuietWork&) = delete;
  QuietWork& operator=(const QuietWork&) = delete;

  // Work under way for an earlier map ends, and its change is part of the new one. `wake` is called
  // from the thread at its end.
  void Start(Map depth, Map sigma, const Backdrop& backdrop, const PixelBounds& changed,
             std::function<void()> wake);
  void Stop();  // and forgets the change
  bool is_busy() const { return thread_.joinable(); }
  // The result, once it is there.
  std::optional<Result> Take();

 private:
  void Join();

  std::thread thread_;
  std::atomic<bool> stop_{false}, has_ended_{false};
  PixelBounds changed_;  // that no result covers yet
  Result result_;
};

}  // namespace arthro::app
