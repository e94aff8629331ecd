// The one exception of the project: bad input, files or hardware, said so that a person can act on
// it. `what()` is a whole sentence: what was wrong, where, and what to do. Caught at command
// dispatch, at a job's end and in main; an expected bad outcome is a result with a reason, not an
// Error.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace arthro {

enum class Code {
  kBadArgument,  // a value that no file holds: a command-line flag, an option
  kBadImage,     // missing, truncated or unsuitable picture
  kBadMesh,      // open, self-intersecting, empty or unreadable geometry
  kBadScene,     // scene.json or what it names
  kBadData,      // CSV, JSON and other records
  kFile,         // cannot be opened, written or renamed; disk full
  kDisplay,      // no display, or its OpenGL is too old
  kDevice,       // haptic hardware
  kCancelled,    // the user asked to stop
};

class Error : public std::runtime_error {
 public:
  Error(Code code, const std::string& sentence, std::filesystem::path file = {})
      : std::runtime_error(file.empty() ? sentence : file.string() + ": " + sentence),
        code_(code),
        sentence_(sentence),
        file_(std::move(file)) {}

  Code code() const { return code_; }
  const std::string& sentence() const { return sentence_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  Code code_;
  std::string sentence_;
  std::filesystem::path file_;
};

}  // namespace arthro
