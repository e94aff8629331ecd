// Makes the relief of a noisy depth map in a thread of its own, one map at a time, so that the
// window does not wait for it. After a small change, only its surroundings are made anew.
#pragma once

#include <atomic>
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
  // Once a frame, before the picture: takes over what has been made. Returns whether there was one.
  bool Collect();
  bool busy() const { return work_.valid(); }

 private:
  Source source_, wanted_;  // source of `made_`; source of the relief that is being made
  std::shared_ptr<const DrawnRelief> made_;
  std::atomic<bool> stop_{false};
  std::future<DrawnRelief> work_;  // its destructor waits for the thread
};

}  // namespace arthro::app
