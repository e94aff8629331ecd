#include "authoring/project/asset_writer.h"

#include <fmt/format.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

bool SameBytes(const fs::path& a, const fs::path& b) {
  std::error_code fault;
  if (fs::file_size(a, fault) != fs::file_size(b, fault) || fault) return false;
  return ReadWholeFile(a) == ReadWholeFile(b);
}

}  // namespace

AssetWriter::AssetWriter(const fs::path& folder) : folder_(folder) { MakeFolder(folder); }

AssetWriter::~AssetWriter() {
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

fs::path AssetWriter::NameFor(const fs::path& name,
                              const std::function<bool(const fs::path&)>& is_same, bool& is_there) {
  // Folders inside the scene, one after the other, so that each can be taken away again.
  fs::path inside = folder_;
  for (const fs::path& part : name.parent_path()) MakeFolder(inside /= part);
  for (int number = 1;; ++number) {
    fs::path candidate = name;
    if (number > 1)
      candidate.replace_filename(
          fmt::format("{}-{}{}", name.stem().string(), number, name.extension().string()));
    std::error_code ignored;
    const bool is_taken = fs::exists(fs::symlink_status(folder_ / candidate, ignored));
    is_there = is_taken && is_same(folder_ / candidate);
    if (!is_taken || is_there) return candidate;
  }
}

fs::path AssetWriter::Copy(const fs::path& source, const fs::path& name) {
  const auto is_same = [&](const fs::path& there) {
    std::error_code ignored;
    return fs::equivalent(source, there, ignored) || SameBytes(source, there);
  };
  return Write(name, is_same,
               [&](const fs::path& target) { WriteAtomically(target, ReadWholeFile(source)); });
}

fs::path AssetWriter::Write(const fs::path& name,
                            const std::function<bool(const fs::path&)>& is_same,
                            const std::function<void(const fs::path&)>& write) {
  bool is_there = false;
  const fs::path free_name = NameFor(name, is_same, is_there);
  if (is_there) return free_name;
  write(folder_ / free_name);
  made_.push_back(folder_ / free_name);
  return free_name;
}

}  // namespace arthro::authoring
