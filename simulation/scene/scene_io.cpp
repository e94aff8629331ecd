#include "simulation/scene/scene_io.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/scene/archive_io.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/json_text.h"
#include "simulation/scene/lens_io.h"
#include "simulation/scene/mesh_io.h"
#include "simulation/scene/scene_json.h"
#include "simulation/scene/scene_migration.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// scene.json is written by hand or by this program; a larger one is some other file.
constexpr std::size_t kMaxBytes = 16u << 20;

json ParseScene(const fs::path& file) {
  std::string text;
  try {
    text = ReadWholeFile(file, kMostJsonBytes);
  } catch (const Error& error) {
    throw Error(Code::kBadScene, error.sentence(), file);
  }
  if (text.size() > kMaxBytes)
    throw Error(Code::kBadScene, "this is too large to be a scene.json; check the name", file);
  return ParseJson(text, Code::kBadScene, file);
}

Scene ReadSceneFile(const fs::path& file, std::vector<JsonFault>& faults) {
  json parsed = ParseScene(file);
  MigrateScene(parsed, file);
  return SceneFromJson(parsed, faults);
}

void ThrowFirst(const std::vector<JsonFault>& faults, const fs::path& file) {
  if (faults.empty()) return;
  std::string sentence = faults.front().sentence;
  if (faults.size() > 1)
    sentence += fmt::format(" (and {} more; `arthroscene check` lists all)", faults.size() - 1);
  throw Error(Code::kBadScene, sentence, file);
}

}  // namespace

fs::path SceneFile(const fs::path& scene) {
  std::error_code ignored;
  return fs::is_directory(scene, ignored) ? scene / "scene.json" : scene;
}

Scene ReadScene(const fs::path& scene) {
  if (IsArchive(scene)) {
    const TemporaryFolder folder;
    UnpackScene(scene, folder.path());
    return ReadScene(folder.path());
  }
  std::vector<JsonFault> faults;
  Scene values = ReadSceneFile(SceneFile(scene), faults);
  ThrowFirst(faults, SceneFile(scene));
  return values;
}

LoadedScene LoadScene(const fs::path& scene, std::vector<std::string>& faults) {
  if (IsArchive(scene)) {
    LoadedScene loaded;
    try {
      const auto folder = std::make_shared<const TemporaryFolder>();
      UnpackScene(scene, folder->path());
      loaded = LoadScene(folder->path(), faults);
      loaded.unpacked = folder;
    } catch (const Error& error) {
      faults.push_back(error.what());
    }
    return loaded;
  }
  LoadedScene loaded;
  const fs::path file = SceneFile(scene);
  loaded.folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  // Each part on its own, so that one bad file does not hide the next.
  const auto attempt = [&](const auto& part) {
    try {
      part();
    } catch (const Error& error) {
      faults.push_back(error.what());
    }
  };
  attempt([&] {
    std::vector<JsonFault> json_faults;
    loaded.scene = ReadSceneFile(file, json_faults);
    for (const JsonFault& fault : json_faults)
      faults.push_back(file.string() + ": " + fault.sentence);
  });
  const auto named = [&](const std::string& key, const fs::path& name, const auto& read) {
    if (name.empty()) return;
    attempt([&] {
      std::error_code ignored;
      if (!fs::is_regular_file(loaded.folder / name, ignored))
        throw Error(Code::kBadScene,
                    fmt::format("{} names \"{}\", which is not in the scene's folder; put it there "
                                "or mend the name",
                                key, name.generic_string()),
                    file);
      read(loaded.folder / name);
    });
  };
  const Backdrop& backdrop = loaded.scene.backdrop;
  named("backdrop.panorama", backdrop.panorama,
        [&](const fs::path& path) { loaded.panorama = ReadColourImage(path); });
  named("backdrop.depth", backdrop.depth, [&](const fs::path& path) {
    loaded.depth = ReadDepthMap(path);
    if (!loaded.panorama.empty()) RequireSameSize(loaded.panorama, loaded.depth, path);
  });
  named("scope.lens", loaded.scene.scope.lens,
        [&](const fs::path& path) { loaded.lens = ReadLens(path); });
  for (std::size_t i = 0; i < loaded.scene.tissues.size(); ++i) {
    const Tissue& tissue = loaded.scene.tissues[i];
    SurfaceMesh& surface = loaded.surfaces.emplace_back();
    named(fmt::format("tissues[{}].surface", i), tissue.surface,
          [&](const fs::path& path) { surface = ReadSurface(path, 1.0); });
    named(fmt::format("tissues[{}].mesh", i), tissue.mesh, [](const fs::path&) {});
  }
  return loaded;
}

LoadedScene LoadScene(const fs::path& scene) {
  std::vector<std::string> faults;
  LoadedScene loaded = LoadScene(scene, faults);
  if (faults.empty()) return loaded;
  std::string sentence = faults.front();
  if (faults.size() > 1)
    sentence += fmt::format(" (and {} more; `arthroscene check` lists all)", faults.size() - 1);
  throw Error(Code::kBadScene, sentence);
}

void WriteScene(const fs::path& scene_json, const Scene& scene) {
  std::string text;
  try {
    text = PrettyJson(JsonFromScene(scene));
  } catch (const json::exception&) {
    throw Error(Code::kBadScene,
                "a text of this scene is not valid UTF-8 and cannot be saved; type it again",
                scene_json);
  }
  std::vector<JsonFault> faults;
  SceneFromJson(json::parse(text), faults);  // also catches NaN, which JSON has no word for
  ThrowFirst(faults, scene_json);
  WriteAtomically(scene_json, text);
}

}  // namespace arthro
