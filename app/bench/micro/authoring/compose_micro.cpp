// Composition of rendered clips under their exact homographies, and under homographies 1 px off, as
// a registration would leave them.
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "app/bench/micro/micro_bench.h"
#include "authoring/panorama/compose/compose.h"
#include "authoring/phantom/clip/clip.h"
#include "tests/support/panorama_score.h"

namespace arthro::app {
namespace {

using namespace authoring;

struct ComposeClip {
  std::shared_ptr<Clip> clip;
  std::shared_ptr<Rectifier> rectifier;
  // Drawn beforehand, so that only composition is timed.
  std::vector<cv::Mat> pictures;
  std::vector<FrameResult> places;
};

ComposeClip MakeComposeClip(ClipPreset preset, int width, int frames, double off_px) {
  ClipOptions options = ClipOptionsOf(preset, width, width * 4 / 5);
  options.frames = frames;
  ComposeClip made;
  made.clip = std::make_shared<Clip>(options);
  made.rectifier = std::make_shared<Rectifier>(made.clip->lens(), RectifyOptions{});
  made.places.resize(static_cast<std::size_t>(frames));
  for (int i = 0; i < frames; ++i) {
    made.pictures.push_back(made.clip->Frame(i));
    FrameResult& place = made.places[static_cast<std::size_t>(i)];
    place.index = i;
    place.is_placed = !made.clip->IsBlank(i);
    place.component = 0;
    const cv::Matx33d moved(1, 0, off_px * std::sin(2.4 * i), 0, 1, off_px * std::cos(2.4 * i), 0,
                            0, 1);
    place.panorama_from_rectified =
        moved * made.clip->PanoramaFromRectified(i, made.rectifier->view());
  }
  return made;
}

ComposedPanorama ComposeAll(const ComposeClip& clip) {
  const FrameSource source = [&, at = std::size_t{0}](int& index, cv::Mat& rgb) mutable {
    if (at == clip.pictures.size()) {
      at = 0;
      return false;
    }
    index = static_cast<int>(at);
    rgb = clip.pictures[at++];
    return true;
  };
  ComposeOptions options;
  options.most_megapixels = 12;
  ComposeReport report;
  return Compose(source, *clip.rectifier, clip.places, options, &report, {});
}

}  // namespace

MicroGroup ComposeMicro(bool quick) {
  MicroGroup group{"compose", "1 - SSIM, %", "plane that the clip shows", {}};
  struct Kind {
    const char* name;
    ClipPreset preset;
    int frames;
    double off_px;
  };
  for (const Kind& kind :
       {Kind{"easy", ClipPreset::kEasy, 32, 0}, Kind{"medium", ClipPreset::kMedium, 40, 0},
        Kind{"hard", ClipPreset::kHard, 48, 0}, Kind{"tool", ClipPreset::kTool, 32, 0},
        Kind{"easy, 1 px off", ClipPreset::kEasy, 32, 1},
        Kind{"hard, 1 px off", ClipPreset::kHard, 48, 1},
        Kind{"long", ClipPreset::kLong, 120, 0}}) {
    const int width = quick ? 320 : 800, frames = quick ? 8 : kind.frames;
    const auto clip =
        MadeOnce([=] { return MakeComposeClip(kind.preset, width, frames, kind.off_px); });
    group.functions.push_back(
        {fmt::format("{}, {} frames of {} px", kind.name, frames, width),
         [=] { KeepAlive(ComposeAll(clip())); },
         [=] {
           const ComposedPanorama panorama = ComposeAll(clip());
           const auto score = test::ScorePanorama(panorama.rgba, clip().clip->Panorama(),
                                                  panorama.composed_from_panorama);
           return MicroError{
               100 * (1 - score.ssim),
               fmt::format("{:.2f} dB, SSIM {:.3f}, {:.1f} Mpx", score.psnr, score.ssim,
                           static_cast<double>(panorama.rgba.total()) / 1e6)};
         }});
    if (quick) break;
  }
  return group;
}

}  // namespace arthro::app
