#include "simulation/practice/tissue_loop.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "simulation/core/background_worker.h"

namespace arthro::simulation {
namespace {

// Longest time step; the rest of a longer pause is skipped.
constexpr double kLongestStep = 0.05;  // s

}  // namespace

// Runs one step at a time on the thread of the worker. The servo reads `is_busy` without waiting.
struct TissueLoop::Thread {
  std::atomic<bool> is_busy{false};
  BackgroundWorker worker{true};  // last member: its work ends before is_busy is destroyed
};

TissueLoop::TissueLoop(TissueWorld world, TissuePace pace, double period)
    : world_(std::move(world)), period_(period) {
  world_.Show(shown_);
  pictures_.Write(shown_);
  for (const ImplicitBody& body : world_.implicit())
    solids_.push_back(std::make_unique<Solid>(body));
  if (pace == TissuePace::kThread && !world_.IsEmpty()) thread_ = std::make_unique<Thread>();
  TakeMemory();
}

TissueLoop::~TissueLoop() = default;

void TissueLoop::TakeMemory() noexcept {
  if (thread_ == nullptr) return;
  thread_->is_busy.store(true, std::memory_order_release);
  thread_->worker.Start(
      [](void* loop) noexcept {
        auto* own = static_cast<TissueLoop*>(loop);
        own->world_.TakeMemory();
        own->thread_->is_busy.store(false, std::memory_order_release);
      },
      this);
}

void TissueLoop::Step(const Request& request) noexcept {
  world_.Step(request.tool, request.dt);
  couplings_.Write(world_.coupling());
  PublishSolids();
  Publish();
}

void TissueLoop::PublishSolids() noexcept {
  const std::span<const ImplicitBody> bodies = world_.implicit();
  for (std::size_t i = 0; i < solids_.size(); ++i) {
    if (bodies[i].IsLost() || bodies[i].shape_version() == solids_[i]->version) continue;
    solids_[i]->version = bodies[i].shape_version();
    solids_[i]->newest.Write(bodies[i].solid());
  }
}

// Skips writing while every body sleeps and slept before.
void TissueLoop::Publish() noexcept {
  const auto is_asleep = [](const BodyPicture& body) { return body.report.is_asleep; };
  const bool slept = std::ranges::all_of(shown_.bodies, is_asleep);
  world_.Show(shown_);
  if (!slept || !std::ranges::all_of(shown_.bodies, is_asleep)) pictures_.Write(shown_);
}

void TissueLoop::Reset() {
  if (thread_) thread_->worker.Wait();
  world_.Reset();
  PublishSolids();
  world_.Show(shown_);
  pictures_.Write(shown_);
  TakeMemory();
}

void TissueLoop::Tick(const Instrumentation& tool, double dt) noexcept {
  if (world_.IsEmpty()) return;
  since_ += dt;
  if (since_ < period_ * (1.0 - 1e-9)) return;
  if (thread_ == nullptr) {
    since_ -= period_;
    return Step({tool, period_});
  }
  if (thread_->is_busy.load(std::memory_order_acquire)) return;
  request_ = {tool, std::min(since_, kLongestStep)};
  since_ = 0;
  thread_->is_busy.store(true, std::memory_order_release);
  thread_->worker.Start(
      [](void* loop) noexcept {
        auto* own = static_cast<TissueLoop*>(loop);
        own->Step(own->request_);
        own->thread_->is_busy.store(false, std::memory_order_release);
      },
      this);
}

bool TissueLoop::TakeCoupling(ToolCoupling& coupling) noexcept {
  if (!couplings_.HasNew()) return false;
  coupling = couplings_.Read();
  return true;
}

}  // namespace arthro::simulation
