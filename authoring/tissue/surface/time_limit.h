// Time limit of a job that fills a surface, from its file to the mesh, checked whenever a stage
// reports its progress.
#pragma once

#include <chrono>
#include <filesystem>

#include "simulation/core/progress.h"

namespace arthro::authoring {

class TimeLimit {
 public:
  using Clock = std::chrono::steady_clock;

  TimeLimit(double seconds, Clock::time_point begun = Clock::now())
      : seconds_(seconds), begun_(begun) {}

  double seconds() const { return seconds_; }
  double Left() const;  // s; 0 when it has passed
  bool IsOver() const { return Left() <= 0; }

  // Returns `progress` with a check that throws Error(kBadMesh) once the limit has passed, with the
  // unfinished stage. `triangles` is the count of the surface in `file`.
  Progress Watch(const Progress& progress, const std::filesystem::path& file,
                 std::size_t triangles) const;

 private:
  double seconds_;
  Clock::time_point begun_;
};

// Reports "stage, done of all" now and then. Cheap enough for the innermost loop of a stage.
class StageSteps {
 public:
  StageSteps(const Progress& progress, const char* stage, std::size_t all)
      : progress_(progress), stage_(stage), all_(all) {}

  void Next() {
    if (++done_ % kEvery == 0)
      progress_.Step(stage_,
                     all_ > 0 ? static_cast<double>(done_ % all_) / static_cast<double>(all_) : 0);
  }

 private:
  static constexpr std::size_t kEvery = 8192;
  const Progress& progress_;
  const char* stage_;
  std::size_t all_, done_ = 0;
};

}  // namespace arthro::authoring
