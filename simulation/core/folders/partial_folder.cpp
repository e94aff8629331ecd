#include "simulation/core/folders/partial_folder.h"

#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

// "out", "out/" and "./out" give the same.
fs::path Plain(const fs::path& folder) {
  fs::path plain = fs::absolute(folder).lexically_normal();
  return plain.has_filename() ? plain : plain.parent_path();
}

}  // namespace

PartialFolder::PartialFolder(fs::path target) : target_(std::move(target)) {
  const fs::path plain = Plain(target_);
  std::error_code fault;
  const bool is_there = fs::is_directory(plain, fault);
  if (!is_there && fs::exists(plain, fault))
    throw Error(Code::kFile, "this is a file; give the name of a folder", target_);
  for (fs::path above = plain.parent_path(); !is_there && !fs::exists(above, fault);
       above = above.parent_path())
    made_.insert(made_.begin(), above);
  // Inside a folder that exists, so that the last step never crosses file systems.
  beside_ = (is_there ? plain : plain.parent_path()) /
            fmt::format(".{}.{}.partial", plain.filename().string().substr(0, 200), ::getpid());
  fs::remove_all(beside_, fault);  // left by a dead process of the same number
  if (!fs::create_directories(beside_, fault)) {
    const std::string why = fault ? WhyNotWritten(fault.value()) : "choose another place";
    for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) fs::remove(*folder, fault);
    throw Error(Code::kFile, "this folder could not be made: " + why, target_);
  }
}

PartialFolder::~PartialFolder() {
  std::error_code ignored;
  if (is_in_place_) return;
  fs::remove_all(beside_, ignored);
  for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) fs::remove(*folder, ignored);
}

void PartialFolder::PutInPlace() {
  const fs::path plain = Plain(target_);
  std::error_code fault;
  if (fs::is_directory(plain, fault)) {
    for (const fs::directory_entry& entry : fs::directory_iterator(beside_, fault)) {
      fs::rename(entry.path(), plain / entry.path().filename(), fault);
      if (fault) break;
    }
    if (!fault) fs::remove(beside_, fault);
  } else {
    fs::rename(beside_, plain, fault);
  }
  if (fault)
    throw Error(Code::kFile, "could not be put in place: " + WhyNotWritten(fault.value()), target_);
  is_in_place_ = true;
}

void PartialFolder::PutInPlaceAsNew() {
  std::error_code fault;
  fs::rename(beside_, Plain(target_), fault);  // refused where something is in a folder there
  if (fault == std::errc::directory_not_empty || fault == std::errc::file_exists ||
      fault == std::errc::not_a_directory)
    throw Error(Code::kFile, "another program has just made this; choose another name", target_);
  if (fault)
    throw Error(Code::kFile, "could not be put in place: " + WhyNotWritten(fault.value()), target_);
  is_in_place_ = true;
}

}  // namespace arthro
