#include "app/report/draw_pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "app/view/attempt_picture.h"
#include "app/view/live_tissues.h"
#include "app/view/still_picture.h"
#include "simulation/core/error.h"
#include "simulation/scene/formats/jpeg_bytes.h"
#include "simulation/scope/window_lens.h"
#include "simulation/training/steps/exercise_index.h"
#include "simulation/training/track/tissue_track.h"

namespace arthro::app {
namespace {

constexpr int kEdge = 480;    // px; 58 mm in print at 210 px per inch
constexpr int kQuality = 85;  // 100 is the best

}  // namespace

std::vector<ReportPicture> DrawMoments(const LoadedScene& loaded,
                                       std::span<const simulation::TissueLook> looks,
                                       std::span<const simulation::AttemptFrame> frames,
                                       std::span<const ExerciseTarget> targets,
                                       std::vector<simulation::TrackPiece> track,
                                       std::span<const ReportMoment> moments) {
  std::vector<ReportPicture> pictures;
  if (frames.empty() || moments.empty()) return pictures;
  const simulation::ScopeOptics optics = simulation::OpticsOf(loaded.scene.scope, loaded.lens);
  StillPictures stills(loaded, looks);
  simulation::TissueTrack tissue(std::move(track));
  LiveTissues shown;
  for (const ReportMoment& moment : moments) {
    const auto last = static_cast<double>(frames.size() - 1);
    const double at = std::clamp(std::floor(moment.t / simulation::kFrameTime - 0.5), 0.0, last);
    const simulation::AttemptFrame& frame = frames[static_cast<std::size_t>(at)];
    // A scope that is out of the joint shows nothing.
    if (!frame.tool[Index(simulation::DeviceRole::kScope)].is_inside() ||
        glm::length(glm::dvec3(frame.lens)) >= loaded.scene.backdrop.radius)
      continue;
    shown.Forget();
    shown.Show(tissue.At(moment.t), loaded.scene.tissues, stills.view(), nullptr);
    stills.view().SetLooseBodies(simulation::LooseBodiesIn(targets, frame));
    pictures.push_back(
        {moment, JpegFromColourImage(stills.Draw(PictureOfFrame(frame, optics), kEdge), kQuality)});
  }
  return pictures;
}

std::string SetPictures(AttemptReport& report, const LoadedScene& loaded,
                        std::span<const simulation::TissueLook> looks) {
  const auto moments = MomentsOf(report.attempt, report.frames, report.steps);
  if (moments.empty()) return "";
  try {
    report.pictures =
        DrawMoments(loaded, looks, report.frames, report.targets, report.track, moments);
  } catch (const Error& fault) {
    return fault.what();
  }
  return "";
}

}  // namespace arthro::app
