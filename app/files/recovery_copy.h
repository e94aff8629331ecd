// Keeps a copy of the open document aside while it has unsaved changes, so that a crash, a kill or
// a lost display loses the last second or two; offers such copies at the next start. Written
// beside the window, whole or not at all. The clip of the footage page is no part of the document.
#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "app/files/recovery_folder.h"
#include "app/state/editor_state.h"
#include "authoring/project/incremental_copy.h"

namespace arthro::app {

class RecoveryCopy {
 public:
  // A copy is written so long after the last change, and at least so often while they go on, s.
  static constexpr double kAfterChange = 0.3, kAtLeastEvery = 0.5;

  // `parent`: empty keeps no copy and offers none. `wake` ends the window's sleep.
  explicit RecoveryCopy(std::filesystem::path parent, std::function<void()> wake = {});
  ~RecoveryCopy();  // the copy stays

  // Puts up the offer to restore the newest copy of a program that has ended, if there is one.
  void Offer(EditorState& state);

  // Once a frame; returns at once. `now`: s of a steady clock. Removes the copy once all is saved.
  void Follow(EditorState& state, double now);
  // Until Follow has something to write; infinite where there is nothing.
  double SecondsUntilDue(double now) const;

  // At an end that nobody asked for: the last changes too. True when they are on disk.
  bool WriteNow(const EditorState& state) noexcept;
  // At an end that the user asked for.
  void Remove();

 private:
  void Start(const EditorState& state);
  void Retire();  // the copy that was restored: another one holds its work now
  // Waits for the write under way and takes its result.
  void Collect(EditorState* state);
  void Restore(EditorState& state, RecoverySession session);

  std::filesystem::path parent_;
  std::function<void()> wake_;
  RecoverySession session_;
  std::optional<authoring::IncrementalCopy> copy_;  // in session_
  // The copies that were restored. Steps of the history may still name files in them.
  std::vector<RecoverySession> restored_;
  long long seen_ = -1, in_work_ = -1, written_ = -1;  // states of the document
  double first_change_ = 0, last_change_ = 0;          // times of the unwritten changes, s
  bool is_due_ = false;
  std::future<std::string> writing_;  // the fault; empty: written
};

}  // namespace arthro::app
