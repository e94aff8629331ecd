// The scenes that were opened or saved last, newest first, kept between runs in the user's
// configuration folder. A file that cannot be read or written is not worth a word: the list is then
// empty or not kept.
#pragma once

#include <filesystem>
#include <vector>

namespace arthro::app {

class RecentScenes {
 public:
  // `file` may be empty: the list is then only kept in memory.
  explicit RecentScenes(std::filesystem::path file = {});

  void Add(const std::filesystem::path& scene);
  // Those that are still there.
  std::vector<std::filesystem::path> Existing() const;

 private:
  std::filesystem::path file_;
  std::vector<std::filesystem::path> scenes_;
};

// $XDG_CONFIG_HOME/arthroscene/recent.json, or below ~/.config; empty where there is no home.
std::filesystem::path RecentScenesFile();

}  // namespace arthro::app
