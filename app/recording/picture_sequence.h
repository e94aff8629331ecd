// A recording as numbered PNG files at a constant rate, in a folder of their own, which must be
// empty or new. While they are written, and for good where that ends early, kIncomplete stands
// beside them and says so: what is there is kept, as pictures are whole one by one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "simulation/scene/image.h"

namespace arthro::app {

// "frame-%04d.png" in a folder.
struct PictureNames {
  std::filesystem::path folder;
  std::string before, after;
  int digits = 0;  // at least so many
  std::filesystem::path At(int number) const;
};

// `target` as it was typed: "folder/" or one that is there (frame_%05d.png in it), or
// "folder/frame-%04d.png". None: the name of a film. Throws Error(kBadArgument) for a .png without
// one number of that kind.
std::optional<PictureNames> PictureNamesOf(const std::filesystem::path& target);

// Throws Error(kFile) where they cannot be: the folder above is missing, something is in it.
void CheckPictureFolder(const PictureNames& names);

class PictureSequence {
 public:
  static constexpr const char* kIncomplete = "INCOMPLETE.txt";

  // Makes the folder. Throws as CheckPictureFolder. What is not finished stays as it is.
  explicit PictureSequence(PictureNames names);
  // The last one again costs its bytes only. Throws Error(kFile).
  void Add(const ColourImage& picture);
  int count() const { return count_; }
  // All is on the disk. Throws Error(kFile), also where nothing was added: then no folder is left.
  void Finish();

 private:
  PictureNames names_;
  bool made_folder_ = false;
  int count_ = 0;
  ColourImage last_;
  std::string bytes_;  // bytes of the last picture
};

}  // namespace arthro::app
