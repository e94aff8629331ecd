// Composition of rendered clips under their exact homographies: CPU time a frame, the most memory
// that the process held, and how far the panorama is from the plane that the clip shows. Last, the
// same with homographies off by 1 px, as a registration would leave them.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <sys/resource.h>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "authoring/panorama/compose/compose.h"
#include "authoring/phantom/clip/clip.h"
#include "tests/benchmark/bench_report.h"
#include "tests/support/panorama_score.h"

using namespace arthro;
using namespace arthro::authoring;

namespace {

double PeakMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void Measure(const test::BenchReport& report, const char* name, ClipPreset preset, int frames,
             double off_px) {
  const int width = report.quick() ? 320 : 800;
  ClipOptions clip_options = ClipOptionsOf(preset, width, width * 4 / 5);
  clip_options.frames = frames;
  const Clip clip(clip_options);
  const Rectifier rectifier(clip.lens(), RectifyOptions{});

  // Frames are drawn beforehand, so that only composition is timed.
  std::vector<cv::Mat> pictures;
  std::vector<FrameResult> places(frames);
  for (int i = 0; i < frames; ++i) {
    pictures.push_back(clip.Frame(i));
    places[i].index = i;
    places[i].is_placed = !clip.IsBlank(i);
    places[i].component = 0;
    const cv::Matx33d moved(1, 0, off_px * std::sin(2.4 * i), 0, 1, off_px * std::cos(2.4 * i), 0,
                            0, 1);
    places[i].panorama_from_rectified = moved * clip.PanoramaFromRectified(i, rectifier.view());
  }
  const FrameSource source = [&, at = 0](int& index, cv::Mat& rgb) mutable {
    if (at == frames) {
      at = 0;
      return false;
    }
    index = at++;
    rgb = pictures[index];
    return true;
  };
  ComposeOptions options;
  options.most_megapixels = 12;
  ComposeReport told;
  const std::clock_t start = std::clock();
  const ComposedPanorama panorama = Compose(source, rectifier, places, options, &told, {});
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / frames;
  const auto score =
      test::ScorePanorama(panorama.rgba, clip.Panorama(), panorama.composed_from_panorama);
  report.Row(fmt::format("{}, {} frames, {:.1f} Mpx: CPU a frame", name, frames,
                         static_cast<double>(panorama.rgba.total()) / 1e6),
             {seconds, seconds},
             fmt::format("{:.2f} dB, SSIM {:.3f}, peak {:.0f} MB", score.psnr, score.ssim,
                         PeakMegabytes()));
}

}  // namespace

int main(int argc, char** argv) {
  const test::BenchReport report("composition of placed frames", argc, argv);
  const int divide = report.quick() ? 4 : 1;
  Measure(report, "easy", ClipPreset::kEasy, 32 / divide, 0);
  if (report.quick()) return 0;
  Measure(report, "medium", ClipPreset::kMedium, 40, 0);
  Measure(report, "hard", ClipPreset::kHard, 48, 0);
  Measure(report, "tool", ClipPreset::kTool, 32, 0);
  Measure(report, "easy, 1 px off", ClipPreset::kEasy, 32, 1);
  Measure(report, "hard, 1 px off", ClipPreset::kHard, 48, 1);
  Measure(report, "long", ClipPreset::kLong, 120, 0);
}
