// A folder of results that appear together or not at all: filled beside or inside the target, and
// moved into it at the end. One that is dropped before is removed, with the folders made for it.
#pragma once

#include <filesystem>
#include <vector>

namespace arthro {

class PartialFolder {
 public:
  // Makes beside(), and the folders above `target` that are missing. What `target` holds stays
  // untouched until the end. Throws Error(kFile).
  explicit PartialFolder(std::filesystem::path target);
  ~PartialFolder();
  PartialFolder(const PartialFolder&) = delete;
  PartialFolder& operator=(const PartialFolder&) = delete;

  const std::filesystem::path& beside() const { return beside_; }
  // Moves what was written into the target; files of the same name there are replaced. Throws
  // Error(kFile).
  void PutInPlace();
  // The same for a target that is new: one that others have filled meanwhile is not touched. Throws
  // Error(kFile).
  void PutInPlaceAsNew();

 private:
  std::filesystem::path target_, beside_;
  std::vector<std::filesystem::path> made_;  // folders above the target, outermost first
  bool is_in_place_ = false;
};

}  // namespace arthro
