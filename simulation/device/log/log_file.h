// File of a log under recording. It is private to its owner, since its content can identify a
// person, and ends before the first write that failed, so that it stays readable up to there.
#pragma once

#include <filesystem>
#include <string_view>

namespace arthro::simulation {

class LogFile {
 public:
  // Creates the file with its `head`. Devices and pipes are opened too; a file with content is
  // kept. Throws Error(kFile) where the file has content or cannot be written.
  LogFile(const std::filesystem::path& file, std::string_view head);
  ~LogFile();
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  // Writes nothing after a fault.
  void Write(std::string_view bytes) noexcept;
  bool has_failed() const noexcept { return error_ != 0; }
  // Throws Error(kFile) where a write failed. A second call does nothing.
  void Close();

 private:
  std::filesystem::path file_;
  int descriptor_ = -1, error_ = 0;
};

}  // namespace arthro::simulation
