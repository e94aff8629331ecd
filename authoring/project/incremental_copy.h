// A copy of a document in a folder of its own that is written again and again while the document is
// edited. Parts that have not changed since the last write stay as they are, so that a write costs
// little more than scene.json; parts that lie in a file are copied byte by byte. Each write is
// whole or leaves the one before.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "authoring/project/document.h"

namespace arthro::authoring {

class IncrementalCopy {
 public:
  // `folder` is made by the first write; nobody else may write into it.
  explicit IncrementalCopy(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Throws Error as SaveDocument. The keys of other tools in the scene are kept, because the copy
  // takes the place of the document.
  void Write(const Document& document);

 private:
  // A file that is copied without being read into memory (tetrahedra, a lens): how it was.
  struct Source {
    std::filesystem::path file;
    std::uintmax_t bytes = 0;
    std::filesystem::file_time_type changed;
    bool operator==(const Source&) const = default;
  };
  static Source SourceOf(const std::filesystem::path& file);
  // Copies the file of a part where it is still what was read; true where it did.
  bool CopyFile(const AssetFile& asset, const std::filesystem::path& name,
                const std::shared_ptr<const void>& part);
  void NameAsWritten(const Document& document, const std::shared_ptr<const void>& part,
                     std::filesystem::path& name, std::map<std::string, AssetFile>& files);

  std::filesystem::path folder_;
  std::map<std::string, AssetFile> written_;  // files of the last write, by their name in the copy
  std::set<std::string> copied_;              // files that were copied byte by byte
  std::string listed_;                        // "x-files-written" of the last write; empty: none
  std::map<std::string, Source> sources_;     // sources of parts that are not in memory
};

}  // namespace arthro::authoring
