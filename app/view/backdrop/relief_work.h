// Makes the relief of a noisy depth map in threads of its own, one map at a time, so that the
// window does not wait for it. After a small change, only its surroundings are made anew, and the
// last relief can be had at once, moved by the change and with its noise.
#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <memory>

#include <glm/vec2.hpp>

#include "app/view/backdrop/drawn_relief.h"

namespace arthro::app {

class ReliefWork {
 public:
  // Maps and place that a relief is made from. Maps are compared by identity.
  struct Source {
    std::shared_ptr<const DepthMap> depth, sigma;
    glm::ivec2 panorama_size{0};
    Backdrop backdrop;
    friend bool operator==(const Source&, const Source&) = default;
  };

  ReliefWork() = default;
  ~ReliefWork() { stop_ = true; }  // the work under way ends early
  ReliefWork(const ReliefWork&) = delete;
  ReliefWork& operator=(const ReliefWork&) = delete;

  // Returns the relief of `source` if it was collected last. Otherwise returns null, and starts to
  // make it when nothing else is being made: ask again in the next frame.
  std::shared_ptr<const DrawnRelief> Find(const Source& source);
  // The same for the relief of `before` moved by the difference of the maps (WithShift), which
  // takes a tenth of the time. Null and no work where the difference is no small one.
  std::shared_ptr<const DrawnRelief> FindShifted(const Source& source, const Source& before,
                                                 const std::shared_ptr<const DrawnRelief>& made);
  // Once a frame, before the picture: takes over what has been made. Returns whether there was one.
  bool Collect();
  bool busy() const { return quiet_.work.valid() || shifted_.work.valid(); }

 private:
  struct Slot {
    Source source, wanted;  // source of `made`; source of the relief that is being made
    std::shared_ptr<const DrawnRelief> made;
    std::future<std::shared_ptr<const DrawnRelief>> work;  // its destructor waits for the thread
    std::shared_ptr<const DrawnRelief> Find(
        const Source& asked, const std::function<std::shared_ptr<const DrawnRelief>()>& make);
    bool Collect();
  };
  std::atomic<bool> stop_{false};
  Slot quiet_, shifted_;
};

}  // namespace arthro::app
