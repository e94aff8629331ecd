#include "authoring/panorama/compose/compose.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "tests/authoring/panorama/compose/small_clip.h"

namespace arthro::authoring {
namespace {

using test::SmallClip;

// Windows every `step` px along a line.
SmallClip Row(int count, int step) {
  SmallClip clip;
  clip.picture = test::TissuePicture(test::kWindowWidth + (count - 1) * step + 8, 128);
  for (int i = 0; i < count; ++i) clip.corners.emplace_back(4 + i * step, 4);
  return clip;
}

// Scales the light by `factor` behind a camera's gamma of 2.2.
void ScaleLight(cv::Mat& picture, double factor) {
  picture.convertTo(picture, -1, std::pow(factor, 1 / 2.2));
}

TEST(Compose, OneFrameComesBackAsItIs) {
  const SmallClip clip = Row(1, 0);
  ComposeReport report;
  const ComposedPanorama panorama = clip.Compose({}, &report);
  cv::Mat mask;
  const cv::Mat rgb = test::OnPicture(panorama, clip.picture.size(), mask);
  ASSERT_GT(cv::countNonZero(mask), 5000);
  // Rounding once into the panorama, once back out of it.
  EXPECT_LE(cv::norm(rgb, clip.picture, cv::NORM_INF, mask), 2.0);
  EXPECT_EQ(report.frames_contributing, 1);
  EXPECT_EQ(panorama.view.width, panorama.rgba.cols);
  EXPECT_NEAR(panorama.view.focal_px, 300, 1e-6);
}

TEST(Compose, HardCase17ExposureStepOfFourLeavesNoSeam) {
  SmallClip clip = Row(2, 80);
  clip.spoil = [](int index, cv::Mat& window) {
    if (index == 1) ScaleLight(window, 0.25);
  };
  ComposeReport report;
  const ComposedPanorama panorama = clip.Compose({}, &report);
  EXPECT_NEAR(report.gain_spread, std::pow(4, 1 / 2.2), 0.05);
  cv::Mat mask, ratio;
  const cv::Mat rgb = test::OnPicture(panorama, clip.picture.size(), mask);
  // Brightness of columns relative to the truth: one factor everywhere, steps of at most 2 grey
  // levels between stripes of 8 px.
  std::vector<double> off;
  for (int x = 16; x + 8 < rgb.cols - 16; x += 8) {
    const cv::Rect stripe(x, 20, 8, 88);
    off.push_back(cv::mean(rgb(stripe))[1] / cv::mean(clip.picture(stripe))[1]);
  }
  for (std::size_t i = 1; i < off.size(); ++i)
    EXPECT_LE(120 * std::abs(off[i] - off[i - 1]), 2.0) << "at stripe " << i;
  EXPECT_LE(120 * std::abs(off.back() - off.front()), 6.0);
}

TEST(Compose, NoTissueChangesHue) {
  SmallClip clip = Row(6, 30);
  clip.spoil = [](int index, cv::Mat& window) { ScaleLight(window, 1 - 0.1 * index); };
  cv::Mat mask;
  const cv::Mat rgb = test::OnPicture(clip.Compose(), clip.picture.size(), mask);
  const cv::Scalar seen = cv::mean(rgb, mask), truth = cv::mean(clip.picture, mask);
  EXPECT_NEAR(seen[0] / seen[1], truth[0] / truth[1], 0.01);
  EXPECT_NEAR(seen[2] / seen[1], truth[2] / truth[1], 0.01);
}

TEST(Compose, HardCase4ToolAndGlintsThatMoveAreGone) {
  SmallClip clip = Row(12, 16);
  clip.spoil = [](int index, cv::Mat& window) {
    cv::line(window, {40 + 5 * index, 130}, {90, 50}, cv::Scalar(70, 72, 75), 14);  // a shaft
    cv::circle(window, {80, 40}, 7, cv::Scalar::all(255), -1);  // a highlight, fixed to the light
  };
  ComposeReport report;
  cv::Mat mask, off;
  const cv::Mat rgb = test::OnPicture(clip.Compose({}, &report), clip.picture.size(), mask);
  // Judged where most of the frames see past the tool.
  mask.colRange(0, 100).setTo(0);
  mask.colRange(mask.cols - 100, mask.cols).setTo(0);
  cv::absdiff(rgb, clip.picture, off);
  cv::cvtColor(off, off, cv::COLOR_RGB2GRAY);
  cv::Mat spoilt = off > 12;
  spoilt.setTo(0, mask == 0);
  EXPECT_LE(cv::countNonZero(spoilt), 0.02 * cv::countNonZero(mask));
  EXPECT_GT(report.outlier_share, 0.02);
}

TEST(Compose, AlphaFallsSmoothlyToTheBorder) {
  const cv::Mat rgba = Row(2, 60).Compose().rgba;
  cv::Mat alpha;
  cv::extractChannel(rgba, alpha, 3);
  const uchar* row = alpha.ptr<uchar>(alpha.rows / 2);
  const int middle = alpha.cols / 2;
  EXPECT_EQ(row[middle], 255);
  int first_opaque = 0;
  while (row[first_opaque] < 255) ++first_opaque;
  EXPECT_GE(first_opaque, 6);
  EXPECT_LE(first_opaque, 12);  // a feather of 8 px, the window's own margin aside
  for (int x = 1; x <= first_opaque; ++x) EXPECT_GE(row[x], row[x - 1]);
}

TEST(Compose, TooLargeAPanoramaIsMadeSmaller) {
  const SmallClip clip = Row(4, 60);
  ComposeOptions options;
  options.most_megapixels = 0.1;
  ComposeReport report;
  SmallClip wide = clip;
  std::vector<FrameResult> places = clip.Places();
  for (FrameResult& place : places)  // places for ten times the size
    place.panorama_from_rectified =
        cv::Matx33d(10, 0, 0, 0, 10, 0, 0, 0, 1) * place.panorama_from_rectified;
  const ComposedPanorama panorama =
      Compose(clip.Source(), test::PinholeRectifier(), places, options, &report, {});
  EXPECT_LE(panorama.rgba.total(), 100000u);
  EXPECT_GT(panorama.rgba.total(), 90000u);
  EXPECT_LT(report.scale, 0.2);
  EXPECT_NEAR(panorama.view.focal_px, 300 * 10 * report.scale, 1e-6);
}

TEST(Compose, NothingPlacedIsAnEmptyPicture) {
  const SmallClip none;
  EXPECT_TRUE(none.Compose().rgba.empty());
  SmallClip clip = Row(2, 60);
  ComposeReport report;
  std::vector<FrameResult> places = clip.Places();
  for (FrameResult& place : places) place.is_placed = false;
  EXPECT_TRUE(
      Compose(clip.Source(), test::PinholeRectifier(), places, {}, &report, {}).rgba.empty());
  const FrameSource nothing = [](int&, cv::Mat&) { return false; };
  EXPECT_TRUE(
      Compose(nothing, test::PinholeRectifier(), clip.Places(), {}, &report, {}).rgba.empty());
}

TEST(Compose, FrameOfAnotherSizeIsLeftOutWithAReason) {
  SmallClip clip = Row(3, 40);
  clip.spoil = [](int index, cv::Mat& window) {
    if (index == 1) cv::resize(window, window, {50, 40});
  };
  ComposeReport report;
  EXPECT_FALSE(clip.Compose({}, &report).rgba.empty());
  ASSERT_EQ(report.left_out.size(), 1u);
  EXPECT_EQ(report.left_out[0].index, 1);
  EXPECT_FALSE(report.left_out[0].reason.empty());
  EXPECT_EQ(report.frames_contributing, 2);
}

TEST(Compose, SameBytesAtAnyThreadCount) {
  SmallClip clip = Row(5, 24);
  clip.spoil = [](int index, cv::Mat& window) { ScaleLight(window, 1 - 0.07 * index); };
  const int before = cv::getNumThreads();
  cv::setNumThreads(1);
  const cv::Mat one = clip.Compose().rgba;
  cv::setNumThreads(4);
  const cv::Mat four = clip.Compose().rgba;
  cv::setNumThreads(before);
  ASSERT_EQ(one.size(), four.size());
  EXPECT_EQ(cv::norm(one, four, cv::NORM_L1), 0.0);
}

TEST(Compose, HardCase20StopsInEveryStage) {
  const SmallClip clip = Row(4, 40);
  for (const char* stage : {"look at frames", "even light", "consensus of the frames",
                            "choose frames", "blend low frequencies", "blend", "finish"}) {
    std::atomic<bool> stop = false;
    Progress progress;
    progress.stop = &stop;
    progress.report = [&](std::string_view now, double) { stop = stop || now == stage; };
    try {
      clip.Compose({}, nullptr, progress);
      FAIL() << "did not stop in: " << stage;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Code::kCancelled);
    }
  }
}

TEST(Compose, ObserverSeesThePanoramaGrow) {
  const SmallClip clip = Row(6, 30);
  ComposeOptions options;
  options.preview_every = 2;
  std::vector<int> seen;
  double last = 0;
  clip.Compose(options, nullptr, {}, [&](const cv::Mat& small, double done) {
    cv::Mat alpha;
    cv::extractChannel(small, alpha, 3);
    seen.push_back(cv::countNonZero(alpha));
    EXPECT_GE(done, last);
    last = done;
  });
  ASSERT_GE(seen.size(), 4u);
  EXPECT_LT(seen[0], seen[1]);
  EXPECT_LT(seen[1], seen[2]);
  EXPECT_EQ(last, 1.0);
}

// Allocates memory as OpenCV does and records the peak.
class CountingAllocator : public cv::MatAllocator {
 public:
  cv::UMatData* allocate(int dims, const int* sizes, int type, void* data, std::size_t* step,
                         cv::AccessFlag flags, cv::UMatUsageFlags usage) const override {
    cv::UMatData* held = standard_->allocate(dims, sizes, type, data, step, flags, usage);
    held->prevAllocator = held->currAllocator = this;
    now_ += held->size;
    most_ = std::max(most_, now_);
    return held;
  }
  bool allocate(cv::UMatData* data, cv::AccessFlag, cv::UMatUsageFlags) const override {
    return data != nullptr;
  }
  void deallocate(cv::UMatData* data) const override {
    now_ -= data->size;
    data->prevAllocator = data->currAllocator = standard_;
    standard_->deallocate(data);
  }
  std::size_t most() const { return most_; }

 private:
  cv::MatAllocator* standard_ = cv::Mat::getStdAllocator();
  mutable std::size_t now_ = 0, most_ = 0;
};

TEST(Compose, AFrameMoreCostsOnlyItsCells) {
  // The same strip in 10 and in 40 frames.
  const auto peak = [](int count) {
    SmallClip clip;
    clip.picture = test::TissuePicture(test::kWindowWidth + 128, 128);
    for (int i = 0; i < count; ++i) clip.corners.emplace_back(4 + 120 * i / (count - 1), 4);
    const auto places = clip.Places();
    const int threads = cv::getNumThreads();
    cv::setNumThreads(1);
    const CountingAllocator counter;
    cv::MatAllocator* before = cv::Mat::getDefaultAllocator();
    cv::Mat::setDefaultAllocator(const_cast<CountingAllocator*>(&counter));
    clip.Compose();
    cv::Mat::setDefaultAllocator(before);
    cv::setNumThreads(threads);
    return static_cast<double>(counter.most());
  };
  const double a_frame = (peak(40) - peak(10)) / 30;
  // 13 bytes per cell of 4 x 4 px: colour, weight, share and score; a rectified frame has 3 per
  // pixel.
  const double cells = test::kWindowWidth * test::kWindowHeight / 16.0;
  EXPECT_LE(a_frame, 16 * cells);
}

}  // namespace
}  // namespace arthro::authoring
