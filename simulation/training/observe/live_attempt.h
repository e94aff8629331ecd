// Frames of an attempt that runs: made on the servo's thread from its ticks, and completed with the
// sight of the targets by the thread of the window. A frame that found no room is replaced by one
// that is not valid, so that frame k stands for its time.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "simulation/core/bounded_queue.h"
#include "simulation/practice/servo_loop.h"
#include "simulation/training/observe/loose_bodies.h"
#include "simulation/training/observe/observer.h"
#include "simulation/training/observe/taken_tissue.h"
#include "simulation/training/observe/tick_average.h"

namespace arthro::simulation {

// Watches the ticks from the first one on.
class LiveFrames final : public ServoWatch {
 public:
  // Loose bodies by the number of their target.
  struct Loose {
    std::vector<int> target;
    LooseBodies bodies;
  };
  explicit LiveFrames(std::optional<Loose> loose = {}) : loose_(std::move(loose)) {}
  void AfterTick(const Snapshot& snapshot, double dt) noexcept override;

  // Called by the thread of the window. The following ticks are paused, or no longer.
  void SetPaused(bool is_paused) noexcept { is_paused_.store(is_paused); }
  // Takes the next frame, without lens, sight and taken volume. Returns false where there is none.
  bool Take(AttemptFrame& frame) noexcept;

 private:
  static constexpr std::size_t kRoom = 500;  // frames; five seconds
  struct Numbered {
    std::uint64_t number = 0;
    AttemptFrame frame;
  };
  std::optional<Loose> loose_;
  std::optional<TickAverage> ticks_;
  std::uint64_t pushed_ = 0, taken_ = 0;
  std::optional<Numbered> ahead_;  // waits until the frames before it are replaced
  std::atomic<bool> is_paused_{false};
  BoundedQueue<Numbered> queue_{kRoom};
};

// Completes frames by the present tissues.
class LiveAttempt {
 public:
  // `relief` and `eye` are those of the practice and outlive this.
  LiveAttempt(const LoadedScene& loaded, const std::vector<TargetPlace>& targets,
              const DepthField& relief, const ScopeEye& eye);

  LiveFrames& watch() noexcept { return frames_; }
  // Returns the frames that have ended since the last call, completed; valid until the next call.
  // `world`: present tissues, which `eye` has followed; null: none deforms.
  std::span<const AttemptFrame> Update(const WorldPicture* world);

 private:
  LiveFrames frames_;
  TakenTissue taken_;
  Observer observer_;
  std::vector<AttemptFrame> ended_;
};

}  // namespace arthro::simulation
