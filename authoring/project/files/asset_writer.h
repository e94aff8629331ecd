// Puts the assets of one save into a scene's folder without ever changing a file that is there, and
// removes them again unless the save comes to its end.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "authoring/project/files/written_files.h"

namespace arthro::authoring {

// "depth.tiff", "depth-2.tiff", "depth-3.tiff" for the numbers 1, 2, 3.
std::filesystem::path Numbered(const std::filesystem::path& name, int number);

class AssetWriter {
 public:
  // `known`: files that earlier saves of this scene wrote; the list of an unfinished save holds
  // them too, so that none is forgotten.
  AssetWriter(const std::filesystem::path& folder, WrittenFiles known);
  ~AssetWriter();  // removes what was made, unless Keep was called
  AssetWriter(const AssetWriter&) = delete;
  AssetWriter& operator=(const AssetWriter&) = delete;

  // Returns the name, relative to the folder, under which the asset now lies: the one given, or the
  // first free one after it ("depth-2.tiff") when another file has that name. A file with the very
  // same bytes is taken as it is.
  std::filesystem::path Write(const std::filesystem::path& name,
                              const std::function<void(const std::filesystem::path&)>& write);

  // Known files and new ones.
  const WrittenFiles& files() const { return files_; }
  const std::filesystem::path& folder() const { return folder_; }
  // Notes on disk that `files` may have to be removed, should the save be cut short now.
  void NoteUnfinished();
  void Keep();

 private:
  void MakeFolder(const std::filesystem::path& folder);

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> made_;  // files and folders, in the order they were made
  WrittenFiles files_;
  bool is_noted_ = false;   // on disk, by this save
  bool was_noted_ = false;  // on disk, by a save that was cut short
};

}  // namespace arthro::authoring
