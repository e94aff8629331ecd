#include "authoring/panorama/clip_reports.h"

#include <fmt/format.h>

namespace arthro::authoring {

std::vector<ClipReport> ClipReports(const Clips& clips, const std::vector<FrameReport>& frames) {
  std::vector<ClipReport> reports;
  for (const std::filesystem::path& clip : clips) reports.push_back({clip.string()});
  for (const FrameReport& frame : frames) {
    if (frame.clip < 0 || frame.clip >= static_cast<int>(reports.size())) continue;
    ClipReport& report = reports[static_cast<std::size_t>(frame.clip)];
    if (report.frames++ == 0) report.first_frame = frame.index;
    report.usable += frame.is_usable;
    report.placed += frame.is_placed;
  }
  return reports;
}

std::vector<std::string> ClipWarnings(const std::vector<ClipReport>& clips) {
  std::vector<std::string> warnings;
  if (clips.size() < 2) return warnings;
  for (const ClipReport& clip : clips)
    if (clip.placed == 0)
      warnings.push_back(fmt::format(
          "{}: none of its {} frames is in the panorama ({} could be used); tie one of them to a "
          "frame of another clip",
          std::filesystem::path(clip.file).filename().string(), clip.frames, clip.usable));
  return warnings;
}

}  // namespace arthro::authoring
