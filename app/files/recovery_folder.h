// Folders of recovery copies, one per running editor: RecoveryFolder()/session-XXXXXX, which only
// its user may read. A lock on the folder tells whether its program still runs, whatever the number
// of its process. It holds
//   scene.arthro   the open document, with its unsaved changes
//   about.json     {"schema", "title", "folder": where the document was opened from or saved}
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
  std::filesystem::path copy() const { return folder_ / "scene.arthro"; }
  std::time_t time_of_copy() const;  // 0: there is none
  void Remove();                     // the folder, and the lock

  struct About {
    std::string title;
    std::filesystem::path folder;
  };
  About ReadAbout() const;                    // empty where it cannot be read
  void WriteAbout(const About& about) const;  // Throws Error(kFile).

 private:
  // Not open where the folder is another user's, or another program has the lock.
  static RecoverySession Lock(const std::filesystem::path& folder);

  std::filesystem::path folder_;
  int lock_ = -1;
};

}  // namespace arthro::app
