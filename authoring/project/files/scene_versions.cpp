#include "authoring/project/files/scene_versions.h"

#include <algorithm>
#include <sys/stat.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "authoring/project/files/written_files.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/folders/file_name.h"
#include "simulation/core/json_text.h"
#include "simulation/scene/files/archive_io.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBackup = ".scene.backup-";
constexpr const char* kSnapshot = "scene.snapshot-";
constexpr const char* kSnapshotName = "x-snapshot";

fs::path BackupFile(const fs::path& place, int number) {
  if (IsArchive(place))
    return place.parent_path() / fmt::format(".{}.backup-{}.arthro", place.stem().string(), number);
  return place / fmt::format("{}{}.json", kBackup, number);
}

std::time_t TimeOf(const fs::path& file) {
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0 ? status.st_mtime : 0;
}

// The text of a version: the scene without its list of written files, which is about the folder.
// A text that cannot be read is kept as it is.
std::string VersionText(const fs::path& scene_json, const std::string& snapshot) {
  std::string text = ReadWholeFile(scene_json);
  try {
    auto json = ParseOrderedJson(text, Code::kBadScene, scene_json);
    json.erase(kWrittenFilesKey);
    if (!snapshot.empty()) json[kSnapshotName] = snapshot;
    return json.dump(2) + "\n";
  } catch (const Error&) {
    return text;
  }
}

bool HoldsSame(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::is_regular_file(a, ignored) &&
         fs::file_size(a, ignored) == fs::file_size(b, ignored) &&
         ReadWholeFile(a) == ReadWholeFile(b);
}

// Makes room for a new backup 1.
void Rotate(const fs::path& place) {
  std::error_code ignored;
  fs::remove(BackupFile(place, kBackups), ignored);
  for (int number = kBackups - 1; number >= 1; --number)
    fs::rename(BackupFile(place, number), BackupFile(place, number + 1), ignored);
}

void KeepArchive(const fs::path& archive) {
  if (HoldsSame(BackupFile(archive, 1), archive)) return;
  Rotate(archive);
  // A save puts another file in the place of this one, which stays under its second name.
  std::error_code fault;
  fs::create_hard_link(archive, BackupFile(archive, 1), fault);
  if (fault) WriteAtomically(BackupFile(archive, 1), ReadWholeFile(archive));
}

std::string NameOfSnapshot(const fs::path& file) {
  try {
    const auto json = ParseJson(ReadWholeFile(file), Code::kBadScene, file);
    if (json.contains(kSnapshotName)) return json.at(kSnapshotName).get<std::string>();
  } catch (const std::exception&) {
    // Its file name does as well.
  }
  return file.stem().string().substr(std::string(kSnapshot).size());
}

}  // namespace

bool IsBackupName(const std::string& file_name) { return file_name.starts_with(kBackup); }

void KeepBackup(const fs::path& place) {
  std::error_code ignored;
  const fs::path file = IsArchive(place) ? place : place / "scene.json";
  if (!fs::is_regular_file(file, ignored)) return;
  if (IsArchive(place)) return KeepArchive(place);
  const std::string text = VersionText(file, "");
  const fs::path newest = BackupFile(place, 1);
  if (fs::is_regular_file(newest, ignored) && ReadWholeFile(newest) == text) return;
  const auto saved = fs::last_write_time(file, ignored);
  Rotate(place);
  WriteAtomically(newest, text);
  fs::last_write_time(newest, saved, ignored);
}

void KeepSnapshot(const fs::path& folder, const std::string& name) {
  if (IsArchive(folder))
    throw Error(Code::kBadArgument,
                "an archive holds one version of a scene; save the scene as a folder to keep "
                "snapshots",
                folder);
  const std::string plain = FileNameFrom(name, "");
  if (plain.empty())
    throw Error(Code::kBadArgument, "a snapshot needs a name with a letter or a digit");
  const fs::path file = folder / fmt::format("{}{}.json", kSnapshot, plain);
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(file, ignored)))
    throw Error(Code::kBadArgument, "there is a snapshot of this name; choose another name", file);
  WriteAtomically(file, VersionText(folder / "scene.json", name));
}

std::vector<SceneVersion> VersionsOf(const fs::path& place) {
  std::vector<SceneVersion> versions;
  std::error_code ignored;
  if (!IsArchive(place))
    for (const auto& entry : fs::directory_iterator(place, ignored))
      if (entry.path().filename().string().starts_with(kSnapshot) &&
          entry.path().extension() == ".json")
        versions.push_back({entry.path(), NameOfSnapshot(entry.path()), TimeOf(entry.path())});
  std::sort(versions.begin(), versions.end(),
            [](const SceneVersion& a, const SceneVersion& b) { return a.name < b.name; });
  for (int number = 1; number <= kBackups; ++number)
    if (const fs::path file = BackupFile(place, number); fs::is_regular_file(file, ignored))
      versions.push_back({file, "", TimeOf(file)});
  return versions;
}

}  // namespace arthro::authoring
