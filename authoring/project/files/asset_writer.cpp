#include "authoring/project/files/asset_writer.h"

#include <utility>

#include <fmt/format.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/fingerprint.h"
#include "simulation/scene/files/scene_io.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

bool IsTaken(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(file, ignored));
}

}  // namespace

fs::path Numbered(const fs::path& name, int number) {
  fs::path numbered = name;
  if (number > 1)
    numbered.replace_filename(
        fmt::format("{}-{}{}", name.stem().string(), number, name.extension().string()));
  return numbered;
}

AssetWriter::AssetWriter(const fs::path& folder, WrittenFiles known)
    : folder_(folder), files_(std::move(known)), was_noted_(HasUnfinishedSave(folder)) {
  MakeFolder(folder);
}

AssetWriter::~AssetWriter() {
  if (is_noted_ && !was_noted_) RemoveUnfinishedSave(folder_);
  std::error_code ignored;
  for (auto path = made_.rbegin(); path != made_.rend(); ++path) fs::remove(*path, ignored);
}

void AssetWriter::MakeFolder(const fs::path& folder) {
  std::error_code fault;
  if (fs::is_directory(folder, fault)) return;
  if (fs::create_directory(folder, fault) && !fault) {
    made_.push_back(folder);
    return;
  }
  throw Error(Code::kFile,
              fmt::format("this folder could not be made: {}; choose another place",
                          fault ? fault.message() : "something else has its name"),
              folder);
}

void AssetWriter::NoteUnfinished() {
  WriteUnfinishedSave(folder_, files_);
  is_noted_ = true;
}

void AssetWriter::Keep() {
  made_.clear();
  is_noted_ = false;
}

fs::path AssetWriter::Write(const fs::path& name,
                            const std::function<void(const fs::path&)>& write) {
  RequireInFolder(folder_, name.parent_path().empty() ? fs::path(".") : name.parent_path());
  // Folders inside the scene, one after the other, so that each can be removed again.
  fs::path inside = folder_;
  for (const fs::path& part : name.parent_path()) MakeFolder(inside /= part);
  int number = 1;
  while (IsTaken(folder_ / Numbered(name, number))) ++number;
  fs::path free_name = Numbered(name, number);
  PartialFile partial(folder_ / free_name);
  write(partial.beside());
  const std::string mark = FingerprintOf(ReadWholeFile(partial.beside()));
  for (int taken = 1; taken < number; ++taken)
    if (FingerprintOfFile(folder_ / Numbered(name, taken)) == mark) return Numbered(name, taken);

  // Noted first: a save that is cut short between the two leaves no file that nobody knows.
  files_[free_name.generic_string()] = mark;
  NoteUnfinished();
  if (IsTaken(folder_ / free_name))
    throw Error(Code::kFile, "another program has just made a file of this name; save again",
                folder_ / free_name);
  partial.PutInPlace();
  made_.push_back(folder_ / free_name);
  return free_name;
}

}  // namespace arthro::authoring
