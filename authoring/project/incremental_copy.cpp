#include "authoring/project/incremental_copy.h"

#include <algorithm>

#include "authoring/project/document_extensions.h"
#include "authoring/project/document_io.h"
#include "authoring/project/files/asset_writer.h"
#include "authoring/project/files/written_files.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/fingerprint.h"
#include "simulation/scene/files/scene_files.h"
#include "simulation/scene/files/scene_io.h"

namespace arthro::authoring {

namespace fs = std::filesystem;

IncrementalCopy::Source IncrementalCopy::SourceOf(const fs::path& file) {
  std::error_code ignored;
  return {file, fs::file_size(file, ignored), fs::last_write_time(file, ignored)};
}

// Gives a part the name under which the last write kept it, if it did; else one that is free.
void IncrementalCopy::NameAsWritten(const Document& document,
                                    const std::shared_ptr<const void>& part, fs::path& name,
                                    std::map<std::string, AssetFile>& files) {
  if (name.empty() && !part) return;
  const fs::path source = name.empty() ? fs::path() : FileOf(document, name);
  const auto is_kept = [&](const auto& entry) {
    if (part) return entry.second.part.lock() == part;
    const auto known = sources_.find(entry.first);
    return known != sources_.end() && known->second == SourceOf(source);
  };
  const auto kept = std::find_if(written_.begin(), written_.end(), is_kept);
  if (kept != written_.end()) {
    name = kept->first;
    files[kept->first] = kept->second;
    return;
  }
  if (name.empty()) return;  // the save will name it
  const auto known = document.files.find(name.generic_string());
  AssetFile asset = known != document.files.end() ? known->second : AssetFile{};
  asset.file = source;
  const auto is_other = [&](const std::string& taken) {
    return written_.contains(taken) || (files.contains(taken) && files.at(taken).file != source);
  };
  int number = 1;
  while (is_other(Numbered(name, number).generic_string())) ++number;
  name = Numbered(name, number);
  files[name.generic_string()] = asset;
  if (CopyFile(asset, name, part)) files[name.generic_string()].file = fs::absolute(folder_ / name);
}

bool IncrementalCopy::CopyFile(const AssetFile& asset, const fs::path& name,
                               const std::shared_ptr<const void>& part) {
  std::error_code fault;
  if (asset.fingerprint.empty() || asset.part.lock() != part ||
      fs::exists(fs::symlink_status(folder_ / name, fault)))
    return false;
  const std::string bytes = ReadWholeFile(asset.file);
  if (FingerprintOf(bytes) != asset.fingerprint) return false;
  fs::create_directories((folder_ / name).parent_path(), fault);
  WriteAtomically(folder_ / name, bytes);
  copied_.insert(name.generic_string());
  return true;
}

void IncrementalCopy::Write(const Document& document) {
  fs::create_directory(folder_);
  Document next = document;
  next.folder = folder_;
  next.files.clear();
  bool has_new_part = false;  // one that no file was named or written for
  const auto keep = [&](fs::path& name, const std::shared_ptr<const void>& part) {
    NameAsWritten(document, part, name, next.files);
    has_new_part = has_new_part || (part && name.empty());
  };
  Backdrop& backdrop = next.scene.backdrop;
  keep(backdrop.panorama, next.panorama);
  keep(backdrop.depth, next.depth);
  keep(backdrop.depth_sigma, next.depth_sigma);
  keep(backdrop.depth_origin, next.depth_origin);
  UnmendedDepth& unmended = next.unmended;
  keep(unmended.depth_file, unmended.depth);
  keep(unmended.sigma_file, unmended.sigma);
  keep(unmended.origin_file, unmended.origin);
  PutUnmendedKey(next);
  keep(backdrop.footage, next.footage);
  if (!next.lens) keep(next.scene.scope.lens, nullptr);  // else it is written from memory
  for (std::size_t i = 0; i < next.scene.tissues.size(); ++i) {
    keep(next.scene.tissues[i].surface, i < next.surfaces.size() ? next.surfaces[i] : nullptr);
    keep(next.scene.tissues[i].mesh, nullptr);
  }
  for (const ExerciseFile& file : ExerciseFilesOf(next.scene)) keep(*file.name, nullptr);

  // Nothing but values has changed: the files stay.
  const auto is_written = [&](const fs::path& name) {
    return next.files.contains(name.generic_string()) && written_.contains(name.generic_string());
  };
  const std::vector<fs::path> names = FilesNamedBy(next.scene);
  if (!has_new_part && !next.lens && next.panorama && next.depth &&
      std::all_of(names.begin(), names.end(), is_written)) {
    PutDocumentKeys(next);
    if (!listed_.empty()) next.scene.extensions[kWrittenFilesKey] = listed_;
    return WriteScene(folder_ / "scene.json", next.scene);
  }

  SaveOptions options;
  options.packs_quickly = true;
  Document saved = SaveDocument(next, folder_, options);
  written_ = saved.files;
  std::erase_if(copied_, [&](const std::string& name) {
    std::error_code ignored;
    return !written_.contains(name) && (fs::remove(folder_ / name, ignored), true);
  });
  const auto listed = saved.scene.extensions.find(kWrittenFilesKey);
  listed_ = listed != saved.scene.extensions.end() ? listed->second : "";
  sources_.clear();
  const auto note = [&](const fs::path& name, const fs::path& in_copy) {
    if (!name.empty()) sources_[in_copy.generic_string()] = SourceOf(FileOf(document, name));
  };
  if (!document.lens) note(document.scene.scope.lens, saved.scene.scope.lens);
  for (std::size_t i = 0; i < saved.scene.tissues.size(); ++i)
    note(document.scene.tissues[i].mesh, saved.scene.tissues[i].mesh);
  Scene named = document.scene;
  const auto before = ExerciseFilesOf(named), after = ExerciseFilesOf(saved.scene);
  for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i)
    note(*before[i].name, *after[i].name);
}

}  // namespace arthro::authoring
