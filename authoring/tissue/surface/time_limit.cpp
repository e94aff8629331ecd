#include "authoring/tissue/surface/time_limit.h"

#include <algorithm>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::authoring {

double TimeLimit::Left() const {
  return std::max(0.0, seconds_ - std::chrono::duration<double>(Clock::now() - begun_).count());
}

Progress TimeLimit::Watch(const Progress& progress, const std::filesystem::path& file,
                          std::size_t triangles) const {
  Progress watched;
  watched.stop = progress.stop;
  watched.report = [limit = *this, report = progress.report, file, triangles](
                       std::string_view stage, double done) {
    if (limit.IsOver())
      throw Error(
          Code::kBadMesh,
          fmt::format("{} did not finish in time ({:g} s); use a surface of fewer triangles "
                      "(this one has {}) or a longer --time-limit",
                      stage, limit.seconds(), triangles),
          file);
    if (report) report(stage, done);
  };
  return watched;
}

}  // namespace arthro::authoring
