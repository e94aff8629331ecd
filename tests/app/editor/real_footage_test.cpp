// A frame of real endoscopic footage as a panorama: depth by the job, then a practice session on
// it.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>
#include <opencv2/videoio.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/image_io.h"
#include "tests/support/run_window.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

namespace arthro {
namespace {

ColourImage FrameOf(const std::filesystem::path& video, int index) {
  cv::VideoCapture capture(video.string());
  cv::Mat bgr;
  for (int i = 0; i <= index; ++i)
    if (!capture.read(bgr)) return {};
  ColourImage image(bgr.cols, bgr.rows);
  for (int y = 0; y < bgr.rows; ++y)
    for (int x = 0; x < bgr.cols; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = bgr.at<cv::Vec3b>(y, x)[2 - c];
  return image;
}

TEST(RealFootage, AFrameGetsDepthAndCanBePractisedOn) {
  ARTHRO_REQUIRE_SHARED(clip, "data/laparoscopy_rvim/endo.mp4");
  ARTHRO_REQUIRE_XVFB();
  test::TempFolder folder;
  const ColourImage frame = FrameOf(clip, 60);
  ASSERT_FALSE(frame.empty()) << clip;
  WriteColourImage(folder / "frame.png", frame);

  const auto depth = test::RunProgram("depth " + (folder / "frame.png").string() + " -o " +
                                      (folder / "depth.tiff").string());
  ASSERT_EQ(depth.exit_code, 0) << depth.err;
  // The round window fills most of the frame; its black surround is not tissue.
  const DepthMap relief = ReadDepthMap(folder / "depth.tiff");
  const auto known = std::count_if(relief.relief.begin(), relief.relief.end(),
                                   [](float h) { return std::isfinite(h); });
  const double share = static_cast<double>(known) / static_cast<double>(relief.relief.size());
  std::printf("share of the frame that has depth: %.3f\n", share);
  EXPECT_GT(share, 0.4);
  EXPECT_LT(share, 0.95);

  // 60 degrees across, 50 mm away: what a mosaic of this scope would be laid out as.
  WriteAtomically(folder / "scene.json", R"({"schema": "arthroscene.scene/1", "title": "Real frame",
    "backdrop": {"panorama": "frame.png", "depth": "depth.tiff", "radius": 0.05,
      "projection": {"type": "gnomonic", "centre_px": [639.5, 359.5], "focal_px": 900}},
    "scope": {"view_angle_deg": 0, "field_of_view_deg": 60}})");
  const auto practice = test::RunWindow("practise " + folder.path().string(),
                                        "wait job\nwait frames 10\nhold r 160\nwait frames 5\n"
                                        "expect \"joint surface\"\nshot " +
                                            (folder / "practice.png").string() + "\n");
  ASSERT_EQ(practice.exit_code, 0) << practice.err;
  const ColourImage shot = ReadColourImage(folder / "practice.png");
  // Tissue is red: over the middle of the picture red leads green on most pixels.
  int red = 0, looked_at = 0;
  for (int y = shot.height * 2 / 5; y < shot.height * 3 / 5; ++y)
    for (int x = shot.width * 2 / 5; x < shot.width * 3 / 5; ++x, ++looked_at)
      red += shot.at(x, y)[0] > shot.at(x, y)[1] + 10;
  EXPECT_GT(red, looked_at / 2);
}

}  // namespace
}  // namespace arthro
