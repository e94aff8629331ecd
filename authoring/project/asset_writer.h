// Puts the assets of one save into a scene's folder without ever changing a file that is there, and
// takes them away again unless the save comes to its end.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <vector>

namespace arthro::authoring {

class AssetWriter {
 public:
  explicit AssetWriter(const std::filesystem::path& folder);
  ~AssetWriter();  // removes what was made, unless Keep was called
  AssetWriter(const AssetWriter&) = delete;
  AssetWriter& operator=(const AssetWriter&) = delete;

  // Each returns the name, relative to the folder, under which the asset now lies: the one given,
  // or a free one beside it when another file has that name.
  std::filesystem::path Copy(const std::filesystem::path& source,
                             const std::filesystem::path& name);
  std::filesystem::path Write(const std::filesystem::path& name,
                              const std::function<bool(const std::filesystem::path&)>& is_same,
                              const std::function<void(const std::filesystem::path&)>& write);

  void Keep() { made_.clear(); }

 private:
  std::filesystem::path NameFor(const std::filesystem::path& name,
                                const std::function<bool(const std::filesystem::path&)>& is_same,
                                bool& is_there);
  void MakeFolder(const std::filesystem::path& folder);

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> made_;  // files and folders, in the order they were made
};

}  // namespace arthro::authoring
