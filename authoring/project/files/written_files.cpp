#include "authoring/project/files/written_files.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "authoring/project/files/scene_versions.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/fingerprint.h"
#include "simulation/core/json_text.h"
#include "simulation/scene/files/scene_files.h"
#include "simulation/scene/files/scene_io.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUnfinishedSave = ".unfinished-save.json";

bool IsPlainName(const fs::path& name) {
  return !name.empty() && name.is_relative() && name.has_filename() &&
         std::none_of(name.begin(), name.end(),
                      [](const fs::path& part) { return part == ".." || part == "."; }) &&
         name != "scene.json" && name != kUnfinishedSave;
}

WrittenFiles ListedIn(const Scene& scene, const fs::path& folder) {
  const auto listed = scene.extensions.find(kWrittenFilesKey);
  if (listed == scene.extensions.end()) return {};
  return WrittenFilesFromJson(listed->second, folder / "scene.json");
}

WrittenFiles UnfinishedSaveOf(const fs::path& folder) {
  if (!HasUnfinishedSave(folder)) return {};
  return WrittenFilesFromJson(ReadWholeFile(folder / kUnfinishedSave), folder / kUnfinishedSave);
}

std::set<fs::path> NamesOf(const Scene& scene) {
  const std::vector<fs::path> names = FilesNamedBy(scene);
  return {names.begin(), names.end()};
}

}  // namespace

WrittenFiles WrittenFilesFromJson(const std::string& text, const fs::path& file) {
  WrittenFiles files;
  try {
    const nlohmann::json json = ParseJson(text, Code::kBadScene, file);
    if (!json.is_object()) return {};
    for (const auto& [name, mark] : json.items())
      if (mark.is_string() && IsPlainName(name)) files[name] = mark.get<std::string>();
  } catch (const Error&) {
    return {};  // nothing is known, so nothing is removed
  }
  return files;
}

std::string JsonFromWrittenFiles(const WrittenFiles& files) { return nlohmann::json(files).dump(); }

WrittenFiles WrittenFilesOf(const fs::path& folder) {
  try {
    WrittenFiles files = ListedIn(ReadScene(folder), folder);
    files.merge(UnfinishedSaveOf(folder));
    return files;
  } catch (const Error&) {
    return {};  // nothing is known, so nothing is removed
  }
}

void RemoveLeftovers(const fs::path& folder, const std::set<fs::path>& needed) {
  if (!HasUnfinishedSave(folder)) return;
  try {
    const Scene scene = ReadScene(folder);
    const std::set<fs::path> names = NamesOf(scene);
    const WrittenFiles listed = ListedIn(scene, folder);
    std::error_code ignored;
    for (const auto& [name, mark] : UnfinishedSaveOf(folder))
      if (!names.contains(name) && !listed.contains(name) && IsInFolder(folder, name) &&
          !needed.contains(fs::absolute(folder / name).lexically_normal()) &&
          !IsNamedByAnotherFile(folder, name) && FingerprintOfFile(folder / name) == mark)
        fs::remove(folder / name, ignored);
  } catch (const Error&) {
    return;
  }
}

void WriteUnfinishedSave(const fs::path& folder, const WrittenFiles& files) {
  // A link would lead the list into a file of somebody else.
  std::error_code ignored;
  if (fs::is_symlink(folder / kUnfinishedSave, ignored))
    fs::remove(folder / kUnfinishedSave, ignored);
  WriteAtomically(folder / kUnfinishedSave, JsonFromWrittenFiles(files) + "\n");
}

bool HasUnfinishedSave(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(fs::symlink_status(folder / kUnfinishedSave, ignored));
}

void RemoveUnfinishedSave(const fs::path& folder) {
  std::error_code ignored;
  fs::remove(folder / kUnfinishedSave, ignored);
}

std::string FingerprintOfFile(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(fs::symlink_status(file, ignored))) return "";
  try {
    return FingerprintOf(ReadWholeFile(file));
  } catch (const Error&) {
    return "";
  }
}

bool IsNamedByAnotherFile(const fs::path& folder, const std::string& name) {
  constexpr std::uintmax_t kLargest = 16u << 20;  // bytes, as of a scene.json
  const std::string file_name = fs::path(name).filename().string();
  std::error_code fault;
  for (fs::directory_iterator entry(folder, fault), end; !fault && entry != end;
       entry.increment(fault)) {
    const fs::path& file = entry->path();
    std::error_code ignored;
    if (file.extension() != ".json" || file.filename() == "scene.json" ||
        (file.filename().string().starts_with('.') &&  // our own, and temporaries
         !IsBackupName(file.filename().string())) ||
        !entry->is_regular_file(ignored))
      continue;
    try {
      if (entry->file_size(ignored) > kLargest ||
          ReadWholeFile(file).find(file_name) != std::string::npos)
        return true;
    } catch (const Error&) {
      return true;  // unreadable: it may name it
    }
  }
  return false;
}

}  // namespace arthro::authoring
