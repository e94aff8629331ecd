// Depth from colour: the whole panorama, and the preview that follows a slider, with how far the
// preview is from the whole result averaged over the same pixels.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "authoring/depth/depth_preview.h"
#include "tests/benchmark/bench_report.h"
#include "tests/support/knee_picture.h"
#include "tests/support/preview_error.h"

using namespace arthro;
using namespace arthro::authoring;

int main(int argc, char** argv) {
  test::BenchReport report("depth from colour", argc, argv);
  const int width = report.quick() ? 512 : 4096, height = width / 2;
  const ColourImage panorama = test::KneePicture(width, height);
  const int samples = report.quick() ? 1 : 30;
  for (const int radius : {2, 5}) {
    DepthOptions options;
    options.median_radius = radius;
    report.Measure(
        fmt::format("{} x {}, median radius {}", width, height, radius), 1,
        [&] { test::KeepAlive(DepthFromColour(panorama, options)); }, "is the reference", samples);
  }
  report.Measure(
      "pyramid of the preview", 1, [&] { test::KeepAlive(DepthPreview(panorama)); }, "", samples);
  const DepthPreview preview(panorama);
  for (const DepthLaw law : {DepthLaw::kLinear, DepthLaw::kInverseSquare}) {
    DepthOptions options;
    options.law = law;
    const DepthMap small = preview.Filter(options), whole = DepthFromColour(panorama, options);
    report.Measure(
        fmt::format("preview {} x {}, {}", small.width, small.height,
                    law == DepthLaw::kLinear ? "linear" : "inverse-square"),
        1, [&] { test::KeepAlive(preview.Filter(options)); },
        test::PreviewErrorOf(small, whole, preview.Factor()).Text(), report.quick() ? 1 : 100);
  }
}
