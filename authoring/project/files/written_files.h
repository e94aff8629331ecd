// List of the files that this program wrote into a scene's folder, so that a save may remove the
// ones that are no longer used, and no others. scene.json keeps the list under "x-files-written";
// while a save is under way a hidden file beside it keeps the list of what may have to be removed.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace arthro::authoring {

inline constexpr const char* kWrittenFilesKey = "x-files-written";

// Name within the folder to the fingerprint (core/fingerprint.h) of what was written there.
using WrittenFiles = std::map<std::string, std::string>;

// Names that leave the folder or are not plain are dropped: the list may come from a stranger.
WrittenFiles WrittenFilesFromJson(const std::string& text, const std::filesystem::path& file);
std::string JsonFromWrittenFiles(const WrittenFiles& files);

// The list of scene.json, and that of a save which did not come to its end.
WrittenFiles WrittenFilesOf(const std::filesystem::path& folder);

// The hidden file: written before the first change, removed after the last one.
void WriteUnfinishedSave(const std::filesystem::path& folder, const WrittenFiles& files);
bool HasUnfinishedSave(const std::filesystem::path& folder);
void RemoveUnfinishedSave(const std::filesystem::path& folder);

// Removes what a save that was cut short has left: files of the hidden list that scene.json neither
// names nor lists, unless `needed` holds their paths.
void RemoveLeftovers(const std::filesystem::path& folder,
                     const std::set<std::filesystem::path>& needed);

// "" where there is no such plain file, or a link.
std::string FingerprintOfFile(const std::filesystem::path& file);

// Another JSON file in the folder, such as a second scene, holds this name.
bool IsNamedByAnotherFile(const std::filesystem::path& folder, const std::string& name);

}  // namespace arthro::authoring
