// The long work beside the window: its result is applied by the window's thread, and no other.
#include "app/state/jobs.h"

#include <chrono>
#include <future>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace arthro::app {

// Stands for the editor's state, of which jobs know nothing.
struct EditorState {
  std::vector<std::thread::id> applied_by;
};

namespace {

using namespace std::chrono_literals;

// Asks as the window does, once per frame, until the job has ended. `each` is called before.
template <typename Each>
void FinishWhenEnded(Jobs& jobs, EditorState& state, Each each) {
  do {
    each();
    std::this_thread::sleep_for(1ms);
  } while (!jobs.Finish(state));
}

TEST(Jobs, ResultIsAppliedByTheThreadThatAsks) {
  std::promise<void> woken;
  Jobs jobs([&] { woken.set_value(); });
  EditorState state;
  std::thread::id worked_by;
  jobs.Start("work", [&](const Progress&) -> Jobs::Apply {
    worked_by = std::this_thread::get_id();
    return
        [](EditorState& of_window) { of_window.applied_by.push_back(std::this_thread::get_id()); };
  });
  EXPECT_TRUE(jobs.busy());
  woken.get_future().wait();
  EXPECT_TRUE(state.applied_by.empty());
  FinishWhenEnded(jobs, state, [] {});
  ASSERT_EQ(state.applied_by, std::vector{std::this_thread::get_id()});
  EXPECT_NE(worked_by, std::this_thread::get_id());
  EXPECT_FALSE(jobs.busy());
  EXPECT_FALSE(jobs.Finish(state)) << "a result is taken once";
}

TEST(Jobs, ShowHowFarTheyAreWhileTheyRun) {
  Jobs jobs;
  EditorState state;
  jobs.Start("count", [](const Progress& progress) -> Jobs::Apply {
    for (int i = 0; i <= 200; ++i) {
      progress.Step(i < 100 ? "first" : "second", 0.005 * i);
      std::this_thread::sleep_for(100us);
    }
    return {};
  });
  double last = 0;
  FinishWhenEnded(jobs, state, [&] {
    const double done = jobs.done();
    EXPECT_GE(done, last);
    last = done;
    const std::string stage = jobs.stage();
    EXPECT_TRUE(stage.empty() || stage == "first" || stage == "second") << stage;
  });
  EXPECT_EQ(jobs.done(), 1.0);
  EXPECT_EQ(jobs.stage(), "second");
  EXPECT_TRUE(state.applied_by.empty());
}

TEST(Jobs, StoppedOneThrowsOnceAndLeavesRoomForTheNext) {
  Jobs jobs;
  EditorState state;
  const auto endless = [](const Progress& progress) -> Jobs::Apply {
    for (;;) progress.Step("endless", 0.5);
  };
  jobs.Start("endless work", endless, true);
  EXPECT_TRUE(jobs.blocks_editing());
  try {
    jobs.Start("more", endless);
    ADD_FAILURE() << "two at once";
  } catch (const Error& fault) {
    EXPECT_EQ(fault.code(), Code::kBadArgument);
    EXPECT_NE(std::string(fault.what()).find("endless work"), std::string::npos) << fault.what();
  }
  jobs.Stop();
  try {
    FinishWhenEnded(jobs, state, [] {});
    ADD_FAILURE() << "a stopped job has no result";
  } catch (const Error& fault) {
    EXPECT_EQ(fault.code(), Code::kCancelled);
  }
  EXPECT_FALSE(jobs.busy());
  jobs.Start("next", [](const Progress&) -> Jobs::Apply { return {}; });
  EXPECT_FALSE(jobs.blocks_editing());
  FinishWhenEnded(jobs, state, [] {});
}

TEST(Jobs, FaultReachesTheWindowInPlaceOfAResult) {
  Jobs jobs;
  EditorState state;
  jobs.Start("fault", [](const Progress&) -> Jobs::Apply { throw std::runtime_error("no room"); });
  EXPECT_THROW(FinishWhenEnded(jobs, state, [] {}), std::runtime_error);
  EXPECT_FALSE(jobs.Finish(state));
}

TEST(Jobs, EndOfTheWindowStopsAndAwaitsTheWork) {
  std::atomic<bool> was_stopped{false};
  {
    Jobs jobs;
    jobs.Start("endless", [&](const Progress& progress) -> Jobs::Apply {
      while (!progress.ShouldStop()) std::this_thread::yield();
      was_stopped = true;
      return {};
    });
  }
  EXPECT_TRUE(was_stopped);
}

}  // namespace
}  // namespace arthro::app
