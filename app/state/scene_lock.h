// Mark beside a scene that says which process has it open for editing: .scene.lock in its folder,
// .NAME.arthro.lock beside an archive. The system gives the lock back when the process ends,
// however it ends. A folder that cannot be written has no mark.
#pragma once

#include <filesystem>
#include <string>

namespace arthro::app {

class SceneLock {
 public:
  SceneLock() = default;
  // `place`: a scene's folder or archive. Never throws for what the file system refuses.
  explicit SceneLock(const std::filesystem::path& place);
  ~SceneLock();  // removes the mark
  SceneLock(SceneLock&& other) noexcept;
  SceneLock& operator=(SceneLock&& other) noexcept;

  bool is_held() const { return lock_ >= 0; }
  // "process 1234 on HOST since 13:04", where another one has it; empty: nobody has.
  const std::string& other() const { return other_; }

 private:
  std::filesystem::path file_;
  std::string other_;
  int lock_ = -1;
};

}  // namespace arthro::app
