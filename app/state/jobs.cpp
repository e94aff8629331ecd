#include "app/state/jobs.h"

#include <utility>

#include "simulation/core/crash_stack.h"

namespace arthro::app {

Jobs::~Jobs() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

void Jobs::Start(const std::string& words, Work work, bool blocks_editing) {
  if (busy())
    throw Error(Code::kBadArgument, "\"" + words_ + "\" is still running; wait or stop it");
  words_ = words;
  blocks_editing_ = blocks_editing;
  stop_ = ended_ = false;
  done_ = 0.0;
  apply_ = {};
  fault_ = nullptr;
  {
    const std::lock_guard lock(stage_mutex_);
    stage_.clear();
  }
  thread_ = std::thread([this, work = std::move(work)] {
    const CrashStack crash_stack;
    Progress progress;
    progress.stop = &stop_;
    progress.report = [this](std::string_view stage, double done) {
      done_ = done;
      const std::lock_guard lock(stage_mutex_);
      stage_ = stage;
    };
    try {
      apply_ = work(progress);
    } catch (...) {
      fault_ = std::current_exception();
    }
    ended_ = true;
    if (wake_) wake_();
  });
}

std::string Jobs::stage() const {
  const std::lock_guard lock(stage_mutex_);
  return stage_;
}

bool Jobs::Finish(EditorState& state) {
  if (!thread_.joinable() || !ended_) return false;
  thread_.join();
  if (fault_) std::rethrow_exception(std::exchange(fault_, nullptr));
  if (const Apply apply = std::exchange(apply_, {})) apply(state);
  return true;
}

}  // namespace arthro::app
