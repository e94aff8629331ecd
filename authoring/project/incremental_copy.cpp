#include "authoring/project/incremental_copy.h"

#include <algorithm>

#include "authoring/project/asset_writer.h"
#include "authoring/project/document_io.h"

namespace arthro::authoring {

namespace fs = std::filesystem;

IncrementalCopy::Source IncrementalCopy::SourceOf(const fs::path& file) {
  std::error_code ignored;
  return {file, fs::file_size(file, ignored), fs::last_write_time(file, ignored)};
}

// Gives a part the name under which the last write kept it, if it did; else one that is free.
void IncrementalCopy::NameAsWritten(const Document& document,
                                    const std::shared_ptr<const void>& part, fs::path& name,
                                    std::map<std::string, AssetFile>& files) const {
  if (name.empty()) return;
  const fs::path source = FileOf(document, name);
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
}

void IncrementalCopy::Write(const Document& document) {
  fs::create_directory(folder_);
  Document next = document;
  next.folder = folder_;
  next.files.clear();
  const auto keep = [&](fs::path& name, const std::shared_ptr<const void>& part) {
    NameAsWritten(document, part, name, next.files);
  };
  Backdrop& backdrop = next.scene.backdrop;
  keep(backdrop.panorama, next.panorama);
  keep(backdrop.depth, next.depth);
  keep(backdrop.depth_sigma, next.depth_sigma);
  keep(backdrop.depth_origin, next.depth_origin);
  if (!next.lens) keep(next.scene.scope.lens, nullptr);  // else it is written from memory
  for (std::size_t i = 0; i < next.scene.tissues.size(); ++i) {
    keep(next.scene.tissues[i].surface, i < next.surfaces.size() ? next.surfaces[i] : nullptr);
    keep(next.scene.tissues[i].mesh, nullptr);
  }

  const Document saved = SaveDocument(next, folder_);
  written_ = saved.files;
  sources_.clear();
  const auto note = [&](const fs::path& name, const fs::path& in_copy) {
    if (!name.empty()) sources_[in_copy.generic_string()] = SourceOf(FileOf(document, name));
  };
  if (!document.lens) note(document.scene.scope.lens, saved.scene.scope.lens);
  for (std::size_t i = 0; i < saved.scene.tissues.size(); ++i)
    note(document.scene.tissues[i].mesh, saved.scene.tissues[i].mesh);
}

}  // namespace arthro::authoring
