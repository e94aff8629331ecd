#include "simulation/scene/files/archive_io.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>
#include <sys/stat.h>
#include <vector>
#include <zip.h>

#include <fmt/format.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/files/scene_files.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/mesh/mesh_io.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Archive = std::unique_ptr<zip_t, Discard>;

struct CloseEntry {
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};

// Reason why a zip cannot be opened.
std::string WhyNotOpened(int code) {
  if (code == ZIP_ER_NOZIP) return "it is no zip file";
  if (code == ZIP_ER_MEMORY) return "there is not enough memory";
  if (code == ZIP_ER_OPEN || code == ZIP_ER_NOENT) return "it may not be read";
  return "it is damaged or cut off";
}

Archive Open(const fs::path& file, int flags, const fs::path& named) {
  int code = 0;
  Archive archive(zip_open(file.c_str(), flags, &code));
  if (archive) return archive;
  throw Error(Code::kBadScene,
              fmt::format("this is not a scene archive that can be opened: {}; copy or export it "
                          "again",
                          WhyNotOpened(code)),
              named);
}

// Throws unless `name` is a plain relative path that stays inside whatever folder it is put in.
void RequireInside(const std::string& name, const fs::path& archive) {
  // Longest name that file systems take, in bytes.
  constexpr std::size_t kLongestName = 255, kLongestPath = 1024;  // bytes
  const fs::path path(name);
  const bool is_too_long = name.size() > kLongestPath ||
                           std::any_of(path.begin(), path.end(), [&](const fs::path& part) {
                             return part.native().size() > kLongestName;
                           });
  if (is_too_long)
    throw Error(Code::kBadScene,
                fmt::format("a file in this archive has a name of {} letters (\"{}\"), which no "
                            "scene needs; give it a shorter one and pack it again",
                            name.size(), name),
                archive);
  const bool climbs = std::any_of(path.begin(), path.end(),
                                  [](const fs::path& part) { return part == ".." || part == "."; });
  const bool has_odd_letter = std::any_of(name.begin(), name.end(), [](unsigned char letter) {
    return letter < 0x20 || letter == 0x7f || letter == '\\' || letter == ':';
  });
  if (name.empty() || path.is_absolute() || climbs || has_odd_letter)
    throw Error(Code::kBadScene,
                fmt::format("this archive wants to write outside its folder (\"{}\"), which a "
                            "scene never does; do not use it",
                            fs::path(name).filename().string()),
                archive);
}

struct Entry {
  zip_uint64_t index = 0, bytes = 0;
  std::string name;
};

// Every entry that is a file, checked before the first byte is unpacked.
std::vector<Entry> EntriesOf(zip_t* zip, const fs::path& archive, const ArchiveLimits& limits) {
  const zip_int64_t count = zip_get_num_entries(zip, 0);
  const auto too_large = [&](const std::string& what) {
    throw Error(Code::kBadScene,
                fmt::format("this archive unpacks to more than {}, which no scene needs; do not "
                            "use it",
                            what),
                archive);
  };
  if (count > limits.most_files) too_large(fmt::format("{} files", limits.most_files));
  std::error_code ignored;
  const std::uint64_t packed = fs::file_size(archive, ignored);
  const std::uint64_t most_bytes =
      std::min(limits.most_bytes, std::max(limits.free_bytes, limits.most_per_byte * packed));
  std::vector<Entry> entries;
  std::set<std::string> names;
  zip_uint64_t bytes = 0;
  for (zip_int64_t i = 0; i < count; ++i) {
    zip_stat_t stat;
    const auto index = static_cast<zip_uint64_t>(i);
    constexpr zip_uint64_t kNeeded = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_ENCRYPTION_METHOD;
    if (zip_stat_index(zip, index, 0, &stat) != 0 || (stat.valid & kNeeded) != kNeeded)
      throw Error(Code::kBadScene, "this archive is damaged; copy or export it again", archive);
    const std::string name = stat.name;
    RequireInside(name, archive);
    // Reads names as stored: libzip's conversion turns control bytes into pictures.
    if (const char* const raw = zip_get_name(zip, index, ZIP_FL_ENC_RAW))
      RequireInside(raw, archive);
    zip_uint8_t system = 0;
    zip_uint32_t attributes = 0;
    zip_file_get_external_attributes(zip, index, 0, &system, &attributes);
    const mode_t kind = system == ZIP_OPSYS_UNIX ? (attributes >> 16) & S_IFMT : 0;
    if (name.back() == '/') continue;  // folders are made for the files in them
    if (kind != 0 && kind != S_IFREG)
      throw Error(Code::kBadScene,
                  fmt::format("\"{}\" in this archive is a link or a device, which a scene never "
                              "holds; do not use it",
                              name),
                  archive);
    if (stat.encryption_method != ZIP_EM_NONE)
      throw Error(Code::kBadScene, "this archive is locked by a password; unlock it first",
                  archive);
    if (!names.insert(name).second)
      throw Error(Code::kBadScene,
                  fmt::format("\"{}\" is in this archive twice; export it again", name), archive);
    if (stat.size > most_bytes || (bytes += stat.size) > most_bytes)
      too_large(fmt::format("{} MB", most_bytes >> 20));
    entries.push_back({index, stat.size, name});
  }
  if (!names.contains("scene.json"))
    throw Error(Code::kBadScene,
                "there is no scene.json at the top of this archive; pack the "
                "content of the scene's folder, not the folder",
                archive);
  return entries;
}

void UnpackEntry(zip_t* zip, const Entry& entry, const fs::path& target, const fs::path& archive) {
  const auto damaged = [&] {
    throw Error(
        Code::kBadScene,
        fmt::format("\"{}\" in this archive is damaged; copy or export it again", entry.name),
        archive);
  };
  std::error_code fault;
  fs::create_directories(target.parent_path(), fault);
  if (fault || fs::exists(target, fault) || fault) damaged();  // a file and a folder of one name
  const std::unique_ptr<zip_file_t, CloseEntry> source(zip_fopen_index(zip, entry.index, 0));
  if (!source) damaged();
  std::ofstream stream(target, std::ios::binary);
  std::vector<char> buffer(std::size_t{1} << 16);
  zip_uint64_t bytes = 0;
  zip_int64_t got = 0;
  // The size was declared by a stranger; what really comes is counted.
  while ((got = zip_fread(source.get(), buffer.data(), buffer.size())) > 0 &&
         (bytes += static_cast<zip_uint64_t>(got)) <= entry.bytes && stream)
    stream.write(buffer.data(), got);
  if (got < 0 || bytes != entry.bytes) damaged();
  stream.close();
  if (!stream)
    throw Error(Code::kFile,
                "this archive could not be unpacked, since no more may be written there; free "
                "some space",
                target.parent_path());
}

void AddFile(zip_t* zip, const fs::path& source, const std::string& name, const fs::path& archive) {
  const auto refuse = [&] {
    throw Error(Code::kFile,
                fmt::format("\"{}\" could not be packed; check that it may be read", name),
                archive);
  };
  zip_source_t* bytes = zip_source_file(zip, source.c_str(), 0, -1);
  if (!bytes) refuse();
  const zip_int64_t index = zip_file_add(zip, name.c_str(), bytes, ZIP_FL_ENC_UTF_8);
  if (index < 0) {
    zip_source_free(bytes);
    refuse();
  }
  constexpr zip_uint16_t kFirstOfJanuary1980 = 0x21;  // so that only content makes a difference
  const auto at = static_cast<zip_uint64_t>(index);
  zip_file_set_dostime(zip, at, 0, kFirstOfJanuary1980, 0);
  zip_file_set_external_attributes(zip, at, 0, ZIP_OPSYS_UNIX,
                                   static_cast<zip_uint32_t>(S_IFREG | 0644) << 16);
}

// scene.json first, then what it names, each once, in order of name.
std::vector<std::string> FilesOf(const fs::path& scene) {
  const Scene values = ReadScene(scene);
  std::set<std::string> names;
  for (const fs::path& name : FilesNamedBy(values))
    if (name != "scene.json") names.insert(name.lexically_normal().generic_string());
  std::vector<std::string> files = {"scene.json"};
  files.insert(files.end(), names.begin(), names.end());
  return files;
}

// Reads every file that the scene names as what the scene takes it for, so that no other file is
// carried along under its name.
void RequireWhole(const fs::path& scene) {
  const LoadedScene loaded = LoadScene(scene);
  for (const Tissue& tissue : loaded.scene.tissues)
    if (!tissue.mesh.empty()) ReadTetMesh(FileOf(loaded, tissue.mesh));
}

}  // namespace

bool IsArchive(const fs::path& file) { return file.extension() == ".arthro"; }

void PackScene(const fs::path& scene, const fs::path& archive) {
  const fs::path file = SceneFile(scene);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const std::vector<std::string> files = FilesOf(scene);
  for (const std::string& name : files) {
    std::error_code ignored;
    if (name != "scene.json" && !fs::is_regular_file(folder / name, ignored))
      throw Error(
          Code::kBadScene,
          fmt::format("\"{}\" is not in the scene's folder, so the scene is not complete", name),
          file);
    RequireInFolder(folder, name);
  }
  RequireWhole(scene);
  WriteAtomically(archive, [&](const fs::path& beside) {
    Archive zip = Open(beside, ZIP_CREATE | ZIP_TRUNCATE, archive);
    for (const std::string& name : files)
      AddFile(zip.get(), name == "scene.json" ? file : folder / name, name, archive);
    if (zip_close(zip.get()) != 0)
      throw Error(
          Code::kFile,
          "could not be written: " + WhyNotWritten(zip_error_code_system(zip_get_error(zip.get()))),
          archive);
    static_cast<void>(zip.release());  // closing has freed it
  });
  RemoveLeftovers(archive.parent_path());
}

void UnpackScene(const fs::path& archive, const fs::path& folder, const ArchiveLimits& limits) {
  std::error_code ignored;
  if (!fs::is_regular_file(archive, ignored))
    throw Error(Code::kBadScene, "there is no such archive; check the name", archive);
  const Archive zip = Open(archive, ZIP_RDONLY | ZIP_CHECKCONS, archive);
  for (const Entry& entry : EntriesOf(zip.get(), archive, limits))
    UnpackEntry(zip.get(), entry, folder / entry.name, archive);
}

Error NamedByArchive(const Error& fault, const fs::path& folder, const fs::path& archive) {
  if (fault.file().empty()) return Error(fault.code(), fault.what(), archive);
  const fs::path inside = fault.file().lexically_relative(folder);
  if (inside.empty() || *inside.begin() == "..") return fault;
  return Error(fault.code(), inside.string() + ": " + fault.sentence(), archive);
}

}  // namespace arthro
