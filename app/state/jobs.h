// One piece of long work beside the window: it runs in its own thread, tells how far it is, can be
// stopped, and hands back what to do with its result, which is then done by the window's thread. So
// a job never touches the editor's state, and the window never waits for a job.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "simulation/core/progress.h"

namespace arthro::app {

struct EditorState;

class Jobs {
 public:
  using Apply = std::function<void(EditorState&)>;  // may be empty
  using Work = std::function<Apply(const Progress&)>;

  // `wake` is called from the job's thread when there is something new to show.
  explicit Jobs(std::function<void()> wake = {}) : wake_(std::move(wake)) {}
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  // Only when not busy. `work` gets everything it needs by value. `blocks_editing`: its result
  // takes the document's place, so that edits meanwhile would be lost; a dialog then waits for it.
  void Start(const std::string& words, Work work, bool blocks_editing = false);
  void Stop() { stop_ = true; }

  // Window's thread: if the job has ended, takes its result over, and throws what it threw
  // (Error(kCancelled) too). True when a result was taken over.
  bool Finish(EditorState& state);

  bool busy() const { return thread_.joinable(); }
  bool blocks_editing() const { return blocks_editing_; }
  const std::string& words() const { return words_; }
  double done() const { return done_; }  // 0 to 1
  std::string stage() const;

 private:
  std::function<void()> wake_;
  std::thread thread_;
  std::string words_;
  bool blocks_editing_ = false;
  std::atomic<bool> stop_{false}, ended_{false};
  std::atomic<double> done_{0.0};
  mutable std::mutex stage_mutex_;  // the stage's words only
  std::string stage_;
  Apply apply_;
  std::exception_ptr fault_;
};

}  // namespace arthro::app
