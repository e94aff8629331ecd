#include "app/state/footage/footage_source.h"

#include <cmath>
#include <utility>

#include "authoring/adjustment/mirror_scene.h"
#include "authoring/panorama/report_io.h"
#include "simulation/core/error.h"

namespace arthro::app {

namespace fs = std::filesystem;

authoring::FootageRecord RecordOf(const authoring::PanoramaRequest& request,
                                  const authoring::PanoramaReport& report) {
  authoring::FootageRecord record;
  const authoring::Clips clips = ClipsOf(request);
  for (std::size_t i = 0; i < clips.size(); ++i) {
    authoring::ClipFile& clip = record.clips.emplace_back();
    const fs::path file = fs::absolute(clips[i]).lexically_normal();
    clip.name = (file.filename().empty() ? file.parent_path() : file).filename().string();
    clip.file = file.string();
    try {
      clip.fingerprint = authoring::ClipFingerprint(file);
    } catch (const Error&) {
      clip.fingerprint = kUnknownClip;  // a pattern of files, or a clip that is gone by now
    }
    clip.frames =
        i < report.clips.size() ? report.clips[i].frames : static_cast<int>(report.frames.size());
  }
  record.left_out.assign(request.excluded.begin(), request.excluded.end());
  record.masked = request.masked;
  record.ties = request.ties;
  record.report = JsonFromReport(report);
  return record;
}

Projection ProjectionOf(const authoring::PinholeView& panorama) {
  const auto rounded = [](double px) {
    return std::nearbyint(px / authoring::kCentreStep) * authoring::kCentreStep;
  };
  Projection projection;
  projection.type = ProjectionType::kGnomonic;
  projection.focal_px = panorama.focal_px;
  projection.centre_px = {rounded(panorama.cx), rounded(panorama.cy)};
  return projection;
}

void PutFootage(authoring::Document& document,
                std::shared_ptr<const authoring::FootageRecord> record) {
  document.footage = std::move(record);
  document.scene.backdrop.footage = document.footage ? "footage.json" : "";
}

}  // namespace arthro::app
