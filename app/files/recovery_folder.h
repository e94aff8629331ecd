// Folders of recovery copies, one per running editor: RecoveryFolder()/session-XXXXXX, which only
// its user may read. A lock on the folder tells whether its program still runs, whatever the number
// of its process. It holds
//   scene/   the open document with its unsaved changes, as a scene; "x-recovery" of its scene.json
//            is a RecoveryNote
// or, from earlier versions, scene.arthro and about.json.
#pragma once

#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace arthro::app {

// $XDG_STATE_HOME/arthroscene/recovery, below ~/.local/state where that is not set; empty without a
// home.
std::filesystem::path RecoveryFolder();

// Description of a copy before it is restored.
struct RecoveryNote {
  std::string title;
  std::filesystem::path folder;   // place of the document; empty: it was never saved
  int edits = 0;                  // unsaved ones; 0: not known
  std::string last_edit;          // name of the last one
  bool is_depth_pending = false;  // the depth map is to be made from the picture
  std::string problem;            // why it cannot be restored; empty: it can
};

inline constexpr const char* kRecoveryKey = "x-recovery";
std::string JsonFromRecoveryNote(const RecoveryNote& note);

std::string WordsOfTime(std::time_t time);  // "23 Nov, 13:04:22"

// A session's folder while this program has its lock. Moving hands the lock on.
class RecoverySession {
 public:
  // Makes a new one in `parent`, which is made if need be. Throws Error(kFile).
  static RecoverySession Create(const std::filesystem::path& parent);
  // Those in `parent` that hold a copy and whose program has ended, the newest copy first. Removes
  // the ones with no copy.
  static std::vector<RecoverySession> Left(const std::filesystem::path& parent);

  RecoverySession() = default;
  ~RecoverySession();  // gives the lock back; the folder stays
  RecoverySession(RecoverySession&& other) noexcept;
  RecoverySession& operator=(RecoverySession&& other) noexcept;

  bool is_open() const { return lock_ >= 0; }
  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path scene_folder() const { return folder_ / "scene"; }
  std::filesystem::path copy() const;  // the scene to open
  std::time_t time_of_copy() const;    // 0: there is none
  RecoveryNote ReadNote() const;
  void Remove();  // the folder, and the lock
  void Retire();  // nothing is offered any more; the files stay until Remove

 private:
  // Not open where the folder is another user's, or another program has the lock.
  static RecoverySession Lock(const std::filesystem::path& folder);

  std::filesystem::path folder_;
  int lock_ = -1;
};

}  // namespace arthro::app
