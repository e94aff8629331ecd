// Earlier versions of a saved scene: backups of the last saves, and snapshots that a person named.
// In a scene's folder a version is one more scene file, which shares the assets of the folder:
//   .scene.backup-1.json … .scene.backup-5.json   1 is the newest
//   scene.snapshot-NAME.json
// Files that a version names stay (written_files.h). Backups of an archive S.arthro are archives
// beside it, .S.backup-1.arthro …; an archive has no snapshots.
#pragma once

#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

namespace arthro::authoring {

inline constexpr int kBackups = 5;

struct SceneVersion {
  std::filesystem::path file;  // can be opened as a scene
  std::string name;            // name of a snapshot; empty: a backup
  std::time_t time = 0;        // when it was saved
};

// Keeps the scene that lies at `place`, a folder or an archive, as the newest backup; the oldest of
// kBackups goes. Does nothing where no scene lies there or the newest backup is the same.
// Throws Error(kFile).
void KeepBackup(const std::filesystem::path& place);

// Keeps the scene in `folder` as it is saved now. Throws Error: an archive, an empty name, or one
// that is taken.
void KeepSnapshot(const std::filesystem::path& folder, const std::string& name);

// Snapshots in the order of their names, then backups, the newest first.
std::vector<SceneVersion> VersionsOf(const std::filesystem::path& place);

// The file name of a backup in a scene's folder.
bool IsBackupName(const std::string& file_name);

}  // namespace arthro::authoring
