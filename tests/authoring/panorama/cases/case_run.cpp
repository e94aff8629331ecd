#include "tests/authoring/panorama/cases/case_run.h"

#include <cmath>
#include <cstdio>
#include <ctime>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include "authoring/panorama/preparation/prepare.h"
#include "authoring/phantom/clip/equisolid.h"

namespace arthro::test {
namespace {

using namespace arthro::authoring;

constexpr double kDrawn = 0.5;  // scale of the drawn frames

RectifiedView FullSize(const RectifiedView& drawn) {
  return {static_cast<int>(drawn.width / kDrawn), static_cast<int>(drawn.height / kDrawn),
          drawn.focal_px / kDrawn, (drawn.cx + 0.5) / kDrawn - 0.5,
          (drawn.cy + 0.5) / kDrawn - 0.5};
}

// Nine points of the raw picture: rays by the true lens, pixels by the assumed one.
cv::Matx33d FittedTruth(const Clip& clip, int index, const Lens& believed,
                        const RectifiedView& view) {
  std::vector<cv::Point2d> from, to;
  const cv::Matx33d panorama_from_ray = PanoramaFromRay(clip.PoseOf(index));
  for (int ring = 0; ring < 3; ++ring)
    for (int i = 0; i < (ring == 0 ? 1 : 8); ++i) {
      const double r = 0.425 * ring * clip.lens().circle.r, angle = i * CV_PI / 4;
      const double x = clip.lens().cx + r * std::cos(angle),
                   y = clip.lens().cy + r * std::sin(angle);
      const cv::Vec3d seen = EquisolidRay(believed, x, y);
      const cv::Vec3d p = panorama_from_ray * EquisolidRay(clip.lens(), x, y);
      from.emplace_back(view.cx + view.focal_px * seen[0] / seen[2],
                        view.cy + view.focal_px * seen[1] / seen[2]);
      to.emplace_back(p[0] / p[2], p[1] / p[2]);
    }
  return cv::Matx33d(cv::findHomography(from, to, 0));
}

}  // namespace

ClipOptions CaseOptions(ClipPreset preset, int frames) {
  ClipOptions options = ClipOptionsOf(preset, 400, 320);
  options.frames = frames;
  options.noise *= kDrawn;
  options.shot_noise *= kDrawn;
  return options;
}

ClipScore CaseRun::Score(int component) const {
  return ScorePlaces(nine, truth, is_blank, results, component);
}

ClipScore CaseRun::Against(const CaseRun& other) const {
  std::vector<cv::Matx33d> theirs;
  for (const FrameResult& result : other.results) theirs.push_back(result.panorama_from_rectified);
  return ScorePlaces(nine, theirs, {}, results);
}

std::vector<std::string> CaseRun::reasons() const {
  std::vector<std::string> reasons;
  for (const FrameResult& result : results)
    if (!result.is_placed) reasons.push_back(result.reason);
  return reasons;
}

CaseRun RunCase(const Clip& clip, const CaseSetting& setting) {
  const Lens lens = setting.believed.value_or(clip.lens());
  const Rectifier rectifier(lens, RectifyOptions{});
  CaseRun run;
  run.view = FullSize(rectifier.view());
  run.nine = NinePoints(clip, run.view);

  FrameLooker looker(clip.lens().circle);
  std::vector<cv::Mat> pictures;
  for (int i = 0; i < clip.frames(); ++i) {
    const cv::Mat raw = clip.Frame(i);
    run.looks.push_back(looker.Look(raw));
    pictures.emplace_back();
    rectifier.Rectify(raw, pictures.back());
  }
  MarkBlanks(run.looks);

  std::vector<int> used;
  ClipLookBuilder builder;
  for (int i = 0; i < clip.frames(); ++i) {
    if (!run.looks[static_cast<std::size_t>(i)].blank.empty() && !setting.has_blanks) continue;
    used.push_back(i);
    builder.Add(pictures[static_cast<std::size_t>(i)], rectifier.mask());
  }
  const ClipLook look = builder.Finish();
  std::vector<WorkingFrame> frames;
  const cv::Matx33d full_size = cv::Matx33d::diag({1 / kDrawn, 1 / kDrawn, 1});
  for (const int i : used) {
    run.is_blank.push_back(clip.IsBlank(i));
    frames.push_back(Prepare(i, pictures[static_cast<std::size_t>(i)], kDrawn, rectifier.mask(),
                             look, PrepareOptions{}));
    run.truth.push_back(full_size * (setting.believed ? FittedTruth(clip, i, lens, run.view)
                                                      : clip.PanoramaFromRectified(i, run.view)));
  }
  const std::clock_t begin = std::clock();
  run.results = Register(frames, run.view, rectifier.mask(), setting.options, &run.report, {});
  run.cpu_ms = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  return run;
}

CaseRun RunCase(const ClipOptions& options, const CaseSetting& setting) {
  return RunCase(Clip(options), setting);
}

void Tell(const std::string& name, const CaseRun& run) {
  const ClipScore score = run.Score();
  const std::string line = fmt::format(
      "{}; {} components, pairs {} of {} tried, {} dropped, drift {:.2f} px, camera deviation "
      "{:.4f}, variance factor {:.1f}, drift factor {:.2f}, {:.0f} CPU ms a frame",
      score.Text(), run.report.components, run.report.pairs_kept, run.report.pairs_tried,
      run.report.pairs_dropped, run.report.drift_px, run.report.camera_deviation,
      run.report.variance_factor, run.report.drift_factor,
      run.cpu_ms / static_cast<double>(run.results.size()));
  std::printf("%-24s %s\n", name.c_str(), line.c_str());
  for (const std::string& warning : run.report.warnings) std::printf("    %s\n", warning.c_str());
  ::testing::Test::RecordProperty(name, line);
}

}  // namespace arthro::test
