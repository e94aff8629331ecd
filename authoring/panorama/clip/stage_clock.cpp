#include "authoring/panorama/clip/stage_clock.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "simulation/core/process_cost.h"

namespace arthro::authoring {

StageClock::StageClock(const Progress& whole, std::vector<std::pair<std::string, double>> shares)
    : whole_(whole), shares_(std::move(shares)), started_(std::chrono::steady_clock::now()) {
  for (const auto& [name, share] : shares_) total_ += share;
}

Progress StageClock::Begin(const std::string& name) {
  End();
  cpu_at_begin_ = ProcessCpuMs();
  is_running_ = true;
  costs_.push_back({name, 0});
  before_ = share_ = 0;
  for (const auto& [stage, share] : shares_) {
    if (stage == name) {
      share_ = share;
      break;
    }
    before_ += share;
  }
  Progress stage;
  stage.stop = whole_.stop;
  stage.report = [this](std::string_view words, double done) { Report(words, done); };
  return stage;
}

void StageClock::End() {
  if (!is_running_) return;
  costs_.back().cpu_ms = ProcessCpuMs() - cpu_at_begin_;
  is_running_ = false;
}

void StageClock::Report(std::string_view words, double done) {
  if (!whole_.report) return;
  // The last step belongs to the writer of the result.
  constexpr double kMost = 0.99;
  const double share = (before_ + share_ * std::clamp(done, 0.0, 1.0)) / std::max(total_, 1e-9);
  done_ = std::max(done_, std::min(share, kMost));
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  const std::string left = TimeLeft(seconds, done_);
  whole_.report(left.empty() ? std::string(words) : fmt::format("{}, {}", words, left), done_);
}

std::string TimeLeft(double seconds_so_far, double done) {
  constexpr double kSoonest = 2.0;  // s
  constexpr double kLeastDone = 0.04;
  if (seconds_so_far < kSoonest || done < kLeastDone || done >= 1) return "";
  const double left = seconds_so_far * (1 - done) / done;
  if (left < 1) return "";
  if (left < 20) return fmt::format("about {:.0f} s left", std::ceil(left));
  if (left < 90) return fmt::format("about {:.0f} s left", 10 * std::ceil(left / 10));
  return fmt::format("about {:.0f} min left", std::ceil(left / 60));
}

}  // namespace arthro::authoring
