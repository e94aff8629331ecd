// A stop of the measurement, at every stage.
#include <algorithm>
#include <atomic>
#include <ctime>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "authoring/relief/make_relief.h"
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
