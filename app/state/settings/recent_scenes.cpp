#include "app/state/settings/recent_scenes.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kMostKept = 8;

// A scene's folder, whichever of its names it was opened by.
fs::path PlaceOf(const fs::path& scene) {
  return scene.filename() == "scene.json" ? scene.parent_path() : scene;
}

}  // namespace

RecentScenes::RecentScenes(fs::path file) : file_(std::move(file)) {
  std::error_code ignored;
  if (file_.empty() || !fs::exists(file_, ignored)) return;
  try {
    const auto json = ParseJson(ReadWholeFile(file_, kMostJsonBytes), Code::kBadData, file_);
    for (const auto& scene : json.at("scenes"))
      if (const fs::path place = PlaceOf(scene.get<std::string>());
          std::find(scenes_.begin(), scenes_.end(), place) == scenes_.end())
        scenes_.push_back(place);
  } catch (const std::exception&) {
    scenes_.clear();
  }
}

void RecentScenes::Add(const fs::path& scene) {
  std::error_code error;
  fs::path absolute = PlaceOf(fs::absolute(scene, error).lexically_normal());
  if (absolute.filename().empty()) absolute = absolute.parent_path();  // a slash at its end
  if (error) return;
  std::erase(scenes_, absolute);
  scenes_.insert(scenes_.begin(), absolute);
  if (scenes_.size() > kMostKept) scenes_.resize(kMostKept);
  if (file_.empty()) return;
  nlohmann::json json = {{"scenes", nlohmann::json::array()}};
  for (const auto& path : scenes_) json["scenes"].push_back(path.string());
  try {
    fs::create_directories(file_.parent_path());
    WriteAtomically(file_, json.dump(2) + "\n", Access::kPrivate);  // whose scenes: names
  } catch (const std::exception&) {
    // Not worth interrupting an author.
  }
}

std::vector<fs::path> RecentScenes::Existing() const {
  std::vector<fs::path> existing;
  std::error_code ignored;
  for (const auto& scene : scenes_)
    if (fs::exists(scene, ignored)) existing.push_back(scene);
  return existing;
}

fs::path RecentScenesFile() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config && *config) return fs::path(config) / "arthroscene" / "recent.json";
  const char* home = std::getenv("HOME");
  return home && *home ? fs::path(home) / ".config" / "arthroscene" / "recent.json" : fs::path();
}

}  // namespace arthro::app
