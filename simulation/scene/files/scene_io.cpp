#include "simulation/scene/files/scene_io.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/folders/leftovers.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"
#include "simulation/scene/backdrop/steep_noise.h"
#include "simulation/scene/files/archive_io.h"
#include "simulation/scene/files/scene_files.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/json/lens_io.h"
#include "simulation/scene/json/scene_json.h"
#include "simulation/scene/json/scene_migration.h"
#include "simulation/scene/mesh/mesh_io.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// scene.json is written by hand or by this program; a larger one is some other file.
constexpr std::size_t kMaxBytes = 16u << 20;

std::string ReadSceneText(const fs::path& file) {
  std::string text;
  try {
    text = ReadWholeFile(file, kMostJsonBytes);
  } catch (const Error& error) {
    throw Error(Code::kBadScene, error.sentence(), file);
  }
  if (text.size() > kMaxBytes)
    throw Error(Code::kBadScene, "this is too large to be a scene.json; check the name", file);
  return text;
}

// scene.json of a folder, or the file that was named itself.
fs::path OwnSceneFile(const fs::path& scene) {
  fs::path file = SceneFile(scene);
  if (file != scene) RequireInFolder(scene, file.filename());
  return file;
}

// Each fault begins with its line in the file.
Scene ReadSceneFile(const fs::path& file, std::vector<JsonFault>& faults) {
  const std::string text = ReadSceneText(file);
  json parsed = ParseJson(text, Code::kBadScene, file);
  MigrateScene(parsed, file);
  Scene scene = SceneFromJson(std::move(parsed), faults);
  for (JsonFault& fault : faults)
    fault.sentence = fmt::format("line {}: {}", LineOfKey(text, fault.key), fault.sentence);
  return scene;
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

bool IsInFolder(const fs::path& folder, const fs::path& name) {
  std::error_code fault;
  const fs::path inside = fs::canonical(folder, fault);
  if (fault) return true;  // a folder that is still to be made holds no link
  fs::path file = fs::canonical(folder / name, fault);
  if (fault) {
    // Not there: a link that leads nowhere must not be written through either.
    if (fs::is_symlink(folder / name, fault)) return false;
    file = fs::weakly_canonical((folder / name).parent_path(), fault);
    if (fault) return false;
  }
  return std::mismatch(inside.begin(), inside.end(), file.begin(), file.end()).first ==
         inside.end();
}

void RequireInFolder(const fs::path& folder, const fs::path& name) {
  if (IsInFolder(folder, name)) return;
  throw Error(Code::kBadScene,
              fmt::format("\"{}\" is a link to a file outside the scene's folder, which a scene "
                          "neither reads nor writes; put the file itself there",
                          name.generic_string()),
              folder);
}

Scene ReadScene(const fs::path& scene) {
  if (IsArchive(scene)) {
    const TemporaryFolder folder;
    UnpackScene(scene, folder.path());
    try {
      return ReadScene(folder.path());
    } catch (const Error& error) {
      throw NamedByArchive(error, folder.path(), scene);
    }
  }
  std::vector<JsonFault> faults;
  const fs::path file = OwnSceneFile(scene);
  Scene values = ReadSceneFile(file, faults);
  ThrowFirst(faults, file);
  return values;
}

namespace {

// `unpacked`: folder into which the archive `scene` was unpacked; null for a scene folder.
LoadedScene LoadFolder(const fs::path& scene, std::shared_ptr<const TemporaryFolder> unpacked,
                       std::vector<std::string>& faults) {
  LoadedScene loaded;
  const fs::path file = SceneFile(unpacked ? unpacked->path() : scene);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  loaded.folder = unpacked ? scene : folder;
  loaded.unpacked = std::move(unpacked);
  const auto keep = [&](const Error& error) {
    faults.push_back(NamedByScene(error, loaded).what());
  };
  // Reads each part on its own, so that one bad file does not hide the next.
  const auto attempt = [&](const auto& part) {
    try {
      part();
    } catch (const Error& error) {
      keep(error);
    }
  };
  attempt([&] {
    std::vector<JsonFault> json_faults;
    loaded.scene = ReadSceneFile(OwnSceneFile(loaded.unpacked ? folder : scene), json_faults);
    for (const JsonFault& fault : json_faults) keep(Error(Code::kBadScene, fault.sentence, file));
  });
  const auto named = [&](const std::string& key, const fs::path& name, const auto& read) {
    if (name.empty()) return;
    attempt([&] {
      std::error_code ignored;
      if (!fs::is_regular_file(folder / name, ignored))
        throw Error(Code::kBadScene,
                    fmt::format("{} names \"{}\", which is not in the scene's folder; put it there "
                                "or mend the name",
                                key, name.generic_string()),
                    file);
      RequireInFolder(folder, name);
      AssetFile& asset = loaded.files[name.generic_string()];
      asset.file = fs::absolute(folder / name);
      asset.part = read(folder / name);
    });
  };
  const Backdrop& backdrop = loaded.scene.backdrop;
  using Part = std::shared_ptr<const void>;
  named("backdrop.panorama", backdrop.panorama, [&](const fs::path& path) -> Part {
    return loaded.panorama = Share(ReadColourImage(path));
  });
  named("backdrop.depth", backdrop.depth, [&](const fs::path& path) -> Part {
    loaded.depth = Share(ReadDepthMap(path));
    if (loaded.panorama) RequireSameSize(*loaded.panorama, *loaded.depth, path);
    return loaded.depth;
  });
  named("backdrop.depth_sigma", backdrop.depth_sigma, [&](const fs::path& path) -> Part {
    loaded.depth_sigma = Share(ReadDepthSigma(path));
    if (loaded.depth) RequireSameSize(*loaded.depth, *loaded.depth_sigma, path);
    return loaded.depth_sigma;
  });
  if (loaded.depth && backdrop.depth_sigma.empty())
    if (const std::optional<float> noise = SteepNoise(*loaded.depth, backdrop))
      loaded.depth_sigma = Share(DepthMap(loaded.depth->width, loaded.depth->height, *noise));
  named("backdrop.depth_origin", backdrop.depth_origin, [&](const fs::path& path) -> Part {
    loaded.depth_origin = Share(ReadOriginMap(path));
    if (loaded.depth) RequireSameSize(*loaded.depth, *loaded.depth_origin, path);
    return loaded.depth_origin;
  });
  named("backdrop.footage", backdrop.footage, [](const fs::path&) -> Part { return nullptr; });
  named("scope.lens", loaded.scene.scope.lens, [&](const fs::path& path) -> Part {
    loaded.lens = ReadLens(path);
    return nullptr;
  });
  for (std::size_t i = 0; i < loaded.scene.tissues.size(); ++i) {
    const Tissue& tissue = loaded.scene.tissues[i];
    SharedSurface& surface = loaded.surfaces.emplace_back();
    named(fmt::format("tissues[{}].surface", i), tissue.surface,
          [&](const fs::path& path) -> Part { return surface = Share(ReadSurface(path, 1.0)); });
    named(fmt::format("tissues[{}].mesh", i), tissue.mesh,
          [](const fs::path&) -> Part { return nullptr; });
  }
  const auto only_named = [&](const std::string& key, const fs::path& name) {
    named(key, name, [](const fs::path&) -> Part { return nullptr; });
  };
  for (const auto& [word, name] : UnmendedFilesOf(loaded.scene))
    only_named(std::string(kUnmendedDepthKey) + "." + word, name);
  for (std::size_t i = 0; i < loaded.scene.exercises.size(); ++i) {
    const Exercise& exercise = loaded.scene.exercises[i];
    only_named(fmt::format("exercises[{}].picture", i), exercise.picture);
    only_named(fmt::format("exercises[{}].ghost", i), exercise.ghost);
    for (std::size_t k = 0; k < exercise.steps.size(); ++k)
      only_named(fmt::format("exercises[{}].steps[{}].picture", i, k),
                 BaseOf(exercise.steps[k]).picture);
  }
  return loaded;
}

}  // namespace

LoadedScene LoadScene(const fs::path& scene, std::vector<std::string>& faults) {
  if (!IsArchive(scene)) return LoadFolder(scene, nullptr, faults);
  LoadedScene loaded;
  try {
    const auto folder = std::make_shared<const TemporaryFolder>();
    UnpackScene(scene, folder->path());
    loaded = LoadFolder(scene, folder, faults);
  } catch (const Error& error) {
    faults.push_back(error.what());
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
  SceneFromJson(ParseJson(text, Code::kBadScene, scene_json),
                faults);  // also catches NaN, which JSON has no word for
  ThrowFirst(faults, scene_json);
  const fs::path folder = scene_json.has_parent_path() ? scene_json.parent_path() : fs::path(".");
  RequireInFolder(folder, scene_json.filename());
  WriteAtomically(scene_json, text);
  RemoveLeftovers(folder);
}

}  // namespace arthro
