// The one exception of the project: bad input, files or hardware, said so that a person can act on
// it. `what()` is a whole sentence: what was wrong, where, and what to do. Caught at command
// dispatch, at a job's end and in main; an expected bad outcome is a result with a reason, not an
// Error.
#pragma once

#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

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
  // Sentence and file are made printable (below), since both may hold text of a stranger's file.
  Error(Code code, std::string_view sentence, std::filesystem::path file = {});

  Code code() const { return code_; }
  const std::string& sentence() const { return sentence_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  Code code_;
  std::string sentence_;
  std::filesystem::path file_;
};

// One line that a terminal shows as it is: control and direction characters are written as \x1b or
// \u202e, bytes that are not UTF-8 become U+FFFD, names in quotes are cut after 80 characters.
std::string PrintableLine(std::string_view text);

// One sentence for any exception: what() of an Error, our own words for all others.
std::string DescribeFault(const std::exception& fault);

}  // namespace arthro
