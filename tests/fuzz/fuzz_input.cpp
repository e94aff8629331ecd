#include "tests/fuzz/fuzz_input.h"

#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <stdexcept>
#include <string>
#include <system_error>
#include <unistd.h>

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

// Longest message. It may hold a quotation of 80 characters and the name of a file.
constexpr std::size_t kLongestSentence = 2000;  // bytes

// In memory where that is possible, since a target writes thousands of files per second.
class Folder {
 public:
  Folder() : owner_(::getpid()) {
    const bool has_memory = ::access("/dev/shm", W_OK | X_OK) == 0;
    std::string name = (has_memory ? "/dev/shm" : fs::temp_directory_path().string());
    name += "/arthro_fuzz_XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for fuzz inputs");
    path_ = name;
    ::setenv("TMPDIR", name.c_str(), 1);
  }
  ~Folder() {
    std::error_code ignored;
    if (owner_ == ::getpid()) fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  pid_t owner_;
  fs::path path_;
};

}  // namespace

void Require(bool holds, const char* claim) {
  if (!holds) throw std::logic_error(std::string("this does not hold: ") + claim);
}

void RequireSentence(const Error& error) {
  const std::string_view message = error.what();
  Require(!error.sentence().empty(), "a refusal has a sentence");
  Require(message.size() <= kLongestSentence, "a message is short enough to be read");
  const bool is_line = std::none_of(message.begin(), message.end(), [](unsigned char letter) {
    return letter < 0x20 || letter == 0x7f;
  });
  Require(is_line, "a message is one line without control characters");
}

const fs::path& PrivateFolder() {
  static const Folder folder;
  return folder.path();
}

fs::path InputFile(const char* name, std::string_view bytes) {
  fs::path file = PrivateFolder() / name;
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (descriptor < 0) throw std::runtime_error("a fuzz input cannot be written");
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = ::write(descriptor, bytes.data() + written, bytes.size() - written);
    if (count <= 0) break;
    written += static_cast<std::size_t>(count);
  }
  ::close(descriptor);
  if (written < bytes.size()) throw std::runtime_error("a fuzz input cannot be written");
  return file;
}

}  // namespace arthro::test
