// A stop of the measurement, at every stage.
#include <algorithm>
#include <atomic>
#include <ctime>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "authoring/relief/make/make_relief.h"
#include "simulation/core/error.h"
#include "tests/support/relief/cavity_clip.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

// Processor time of this thread, s: other processes do not count.
double ThreadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Words of a stage without the time that is left.
std::string StageOf(std::string_view words) {
  return std::string(words.substr(0, words.find(',')));
}

TEST(StopRelief, TakesEffectWithinHalfASecondOfProcessorTimeInEveryStage) {
  const test::TempFolder folder;
  test::WriteCavityClip(folder.path(), {});
  ReliefRequest request;
  request.footage = folder.path();
  request.lens = test::CavityLens();
  request.options.threads = 1;  // all work in the thread that is timed
  std::vector<std::string> stages;
  Progress listening;
  listening.report = [&](std::string_view words, double) {
    if (std::find(stages.begin(), stages.end(), StageOf(words)) == stages.end())
      stages.push_back(StageOf(words));
  };
  MakeRelief(request, listening);
  ASSERT_GE(stages.size(), 8u);

  for (const std::string& stage : stages) {
    std::atomic<bool> stop{false};
    double stopped_at = 0;
    Progress progress;
    progress.stop = &stop;
    progress.report = [&](std::string_view words, double) {
      if (stop || StageOf(words) != stage) return;
      stopped_at = ThreadSeconds();
      stop = true;  // the flag was just read, so this is the longest wait
    };
    try {
      MakeRelief(request, progress);
      ADD_FAILURE() << "was not stopped in \"" << stage << '"';
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Code::kCancelled) << error.what();
      EXPECT_LT(ThreadSeconds() - stopped_at, 0.5) << "s, in \"" << stage << '"';
    }
  }
}

// The clip at twice its size: 480 x 400 px.
Lens DoubleClip(const std::filesystem::path& folder) {
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    const std::string name = file.path().string();
    cv::Mat large;
    cv::resize(cv::imread(name), large, {}, 2, 2, cv::INTER_CUBIC);
    cv::imwrite(name, large);
  }
  Lens lens = test::CavityLens();
  lens.width *= 2, lens.height *= 2;
  lens.cx = 2 * lens.cx + 0.5, lens.cy = 2 * lens.cy + 0.5;
  lens.focal_px *= 2;
  lens.circle = {lens.cx, lens.cy, 2 * lens.circle.r};
  return lens;
}

// Each report looks at the stop first, so that the time between two reports is the longest wait.
// Stages that adjust poses look more often than they report; the test above is about them.
TEST(StopRelief, LooksAtTheStopWithinHalfASecondFromTheSweepOn) {
  const test::TempFolder folder;
  test::WriteCavityClip(folder.path(), {});
  ReliefRequest request;
  request.lens = DoubleClip(folder.path());
  request.footage = folder.path();
  request.options.threads = 1;
  std::string before;
  double since = 0;
  std::map<std::string, double> longest;
  Progress progress;
  progress.report = [&](std::string_view words, double) {
    if (!before.empty()) longest[before] = std::max(longest[before], ThreadSeconds() - since);
    before = StageOf(words);
    since = ThreadSeconds();
  };
  ASSERT_TRUE(MakeRelief(request, progress).report.verdict.is_measured());
  longest[before] = std::max(longest[before], ThreadSeconds() - since);
  for (const char* stage :
       {"trying all radii", "refining the surface", "checking the surface", "closing the surface",
        "what each frame sees", "reading brightness", "distances in the panorama",
        "placing the frames", "look at frames", "even light", "choose frames", "blend", "finish"}) {
    ASSERT_TRUE(longest.contains(stage)) << stage;
    EXPECT_LT(longest[stage], 0.5) << "s, in \"" << stage << '"';
  }
}

TEST(ObservedRelief, ShowsPosesAndPointsBeforeTheEnd) {
  const test::TempFolder folder;
  const test::CavityOptions clip;
  test::WriteCavityClip(folder.path(), clip);
  ReliefRequest request;
  request.footage = folder.path();
  request.lens = test::CavityLens();
  std::vector<std::size_t> cameras;
  bool was_in_portal_frame = false;
  MakeRelief(request, {}, [&](const ReliefSoFar& so_far) {
    EXPECT_FALSE(was_in_portal_frame) << "the last call has the portal";
    cameras.push_back(so_far.cameras.size());
    EXPECT_FALSE(so_far.points.empty());
    EXPECT_LE(so_far.points.size(), 1500u);
    was_in_portal_frame = so_far.is_in_portal_frame;
  });
  ASSERT_GE(cameras.size(), 3u);
  EXPECT_TRUE(was_in_portal_frame);
  EXPECT_GE(cameras.back(), cameras.front());
}

TEST(ExcludedFrames, HaveNoPoseAndSayWhy) {
  const test::TempFolder folder;
  test::WriteCavityClip(folder.path(), {});
  ReliefRequest request;
  request.footage = folder.path();
  request.lens = test::CavityLens();
  request.excluded = {2, 5};
  const ReliefResult result = MakeRelief(request, {});
  for (const PosedFrame& frame : result.report.frames) {
    if (!request.excluded.contains(frame.index)) continue;
    EXPECT_FALSE(frame.is_posed);
    EXPECT_EQ(frame.reason, "left out by hand");
  }
}

}  // namespace
}  // namespace arthro::authoring
