// History of the last 10 s of a hand, for plots: the largest |force| and sample age per 20 ms, in a
// ring of fixed size. N, ms, s.
#pragma once

#include <algorithm>
#include <array>

namespace arthro::simulation {

class ForceHistory {
 public:
  static constexpr int kLength = 500;
  static constexpr double kBin = 0.020;      // s
  static constexpr double kRounding = 1e-9;  // s, error of a sum of ticks

  // Adds a force to the present bin.
  void Feel(double force) noexcept { force_ = std::max(force_, force); }
  // Advances by `seconds`, at whose end the sample is `age` old.
  void Pass(double seconds, double age) noexcept {
    age_ = std::max(age_, age);
    // A time longer than the ring fills all of it.
    pending_ = std::min(pending_ + std::max(0.0, seconds), kLength * kBin);
    if (pending_ < kBin - kRounding) return;
    for (; pending_ >= kBin - kRounding; pending_ -= kBin) {
      forces_[static_cast<std::size_t>(next_)] = static_cast<float>(force_);
      ages_[static_cast<std::size_t>(next_)] = static_cast<float>(1e3 * age_);
      next_ = (next_ + 1) % kLength;
    }
    force_ = age_ = 0;
  }

  // Rings as ImGui::PlotLines reads them; the oldest value is at `oldest()`.
  const std::array<float, kLength>& forces() const noexcept { return forces_; }
  const std::array<float, kLength>& ages() const noexcept { return ages_; }
  int oldest() const noexcept { return next_; }

 private:
  std::array<float, kLength> forces_{}, ages_{};
  int next_ = 0;
  double pending_ = 0, force_ = 0, age_ = 0;
};

}  // namespace arthro::simulation
