#include "app/files/recovery_copy.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "app/steps/depth/depth_step.h"
#include "authoring/project/document_io.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

// The document as it is written: with a note of what it holds, and without a depth map that its
// options do not give any more.
authoring::Document ForCopy(const EditorState& state) {
  authoring::Document document = state.document();
  RecoveryNote note;
  note.title = document.scene.title;
  // The next start may be from elsewhere.
  if (!document.folder.empty()) note.folder = fs::absolute(document.folder).lexically_normal();
  note.edits = std::max(1, state.history.StepsFromSaved());
  note.last_edit = state.history.StepName();
  note.is_depth_pending = DepthIsUnderWay(state);
  if (note.is_depth_pending) SetDepth(document, nullptr);
  document.scene.extensions[kRecoveryKey] = JsonFromRecoveryNote(note);
  return document;
}

bool HasUnsavedWork(const EditorState& state) {
  return !state.practice_only && !state.history.IsSaved() && state.document().panorama != nullptr;
}

}  // namespace

RecoveryCopy::RecoveryCopy(fs::path parent, std::function<void()> wake)
    : parent_(std::move(parent)), wake_(std::move(wake)) {}

RecoveryCopy::~RecoveryCopy() { Collect(nullptr); }

void RecoveryCopy::Offer(EditorState& state) {
  if (parent_.empty()) return;
  std::vector<RecoverySession> left = RecoverySession::Left(parent_);
  if (left.empty()) return;
  // Shared, because a dialog is copied; the lock keeps other windows from offering the same.
  const auto session = std::make_shared<RecoverySession>(std::move(left.front()));
  const RecoveryNote note = session->ReadNote();
  RecoveryDialog dialog;
  dialog.title = note.title.empty() ? "Untitled" : note.title;
  dialog.folder = note.folder;
  dialog.edits = note.edits;
  dialog.last_edit = note.last_edit;
  dialog.problem = note.problem;
  dialog.when = WordsOfTime(session->time_of_copy());
  dialog.restore = [this, session](EditorState& now) { Restore(now, std::move(*session)); };
  dialog.discard = [session](EditorState&) { session->Remove(); };
  state.dialogs.push_back(std::move(dialog));
}

void RecoveryCopy::Restore(EditorState& state, RecoverySession session) {
  Collect(nullptr);
  authoring::Document document = authoring::OpenDocument(session.copy());
  document.scene.extensions.erase(kRecoveryKey);
  const RecoveryNote note = session.ReadNote();
  // Saving asks where, unless the scene is as it was when the copy was made.
  std::error_code error;
  const fs::path scene =
      fs::is_directory(note.folder, error) ? note.folder / "scene.json" : note.folder;
  const auto changed = fs::last_write_time(scene, error);
  const bool is_there = !error;
  const bool is_as_it_was = is_there && changed <= fs::last_write_time(session.copy(), error);
  document.folder = is_as_it_was ? note.folder : fs::path();
  const std::string when = WordsOfTime(session.time_of_copy());
  StartDocument(state, std::move(document), false,
                is_as_it_was ? NoteOnDisk(note.folder) : SceneOnDisk{});
  if (note.is_depth_pending) state.steps.depth->cache = {};
  // The old copy protects the document until the next one replaces it.
  session_.Remove();
  copy_.reset();
  restored_.push_back(std::move(session));
  seen_ = written_ = -1;
  state.message = "Restored the unsaved work of " + when + ". Save it to keep it.";
}

void RecoveryCopy::Retire() {
  for (RecoverySession& session : restored_) session.Retire();
}

void RecoveryCopy::Follow(EditorState& state, double now) {
  if (parent_.empty()) return;
  if (writing_.valid()) {
    if (writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    Collect(&state);
  }
  const long long id = state.history.StateId();
  if (!HasUnsavedWork(state)) {
    session_.Remove();
    copy_.reset();
    Retire();
    seen_ = id;
    written_ = -1;
    is_due_ = false;
    return;
  }
  if (id != seen_) {
    seen_ = id;
    last_change_ = now;
    if (!std::exchange(is_due_, true)) first_change_ = now;
  }
  if (!is_due_ || id == written_) {
    is_due_ = false;
    return;
  }
  if (now < std::min(last_change_ + kAfterChange, first_change_ + kAtLeastEvery)) return;
  Start(state);
}

double RecoveryCopy::SecondsUntilDue(double now) const {
  if (!is_due_ || writing_.valid()) return std::numeric_limits<double>::infinity();
  return std::max(0.0, std::min(last_change_ + kAfterChange, first_change_ + kAtLeastEvery) - now);
}

void RecoveryCopy::Start(const EditorState& state) {
  is_due_ = false;
  in_work_ = state.history.StateId();
  writing_ = std::async(std::launch::async, [this, document = ForCopy(state)] {
    std::string fault;
    try {
      if (!session_.is_open()) session_ = RecoverySession::Create(parent_);
      if (!copy_) copy_.emplace(session_.scene_folder());
      copy_->Write(document);
    } catch (const std::exception& error) {
      fault = error.what();
    }
    if (wake_) wake_();
    return fault;
  });
}

void RecoveryCopy::Collect(EditorState* state) {
  if (!writing_.valid()) return;
  const std::string fault = writing_.get();
  if (fault.empty()) {
    written_ = in_work_;
    Retire();
  } else if (state != nullptr) {
    state->message = "There is no recovery copy: " + fault;
  }
}

bool RecoveryCopy::WriteNow(const EditorState& state) noexcept {
  try {
    Collect(nullptr);
    if (parent_.empty() || !HasUnsavedWork(state)) return false;
    if (written_ == state.history.StateId()) return true;
    Start(state);
    Collect(nullptr);
    return written_ == state.history.StateId();
  } catch (...) {
    return false;
  }
}

void RecoveryCopy::Remove() {
  Collect(nullptr);
  session_.Remove();
  copy_.reset();
  for (RecoverySession& session : restored_) session.Remove();
  restored_.clear();
  written_ = -1;
}

}  // namespace arthro::app
