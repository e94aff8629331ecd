// Writing a document as a scene (document_io.h).
#include <algorithm>
#include <cstring>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "authoring/alignment/placing_notes.h"
#include "authoring/depth/strokes/depth_strokes_io.h"
#include "authoring/project/document_extensions.h"
#include "authoring/project/document_io.h"
#include "authoring/project/files/asset_writer.h"
#include "authoring/project/files/file_ending.h"
#include "authoring/project/files/scene_versions.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/fingerprint.h"
#include "simulation/core/folders/file_name.h"
#include "simulation/core/folders/leftovers.h"
#include "simulation/core/folders/partial_folder.h"
#include "simulation/core/option_fields.h"
#include "simulation/scene/backdrop/clean_picture.h"
#include "simulation/scene/files/archive_io.h"
#include "simulation/scene/files/scene_files.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/json/lens_io.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/scene/solids/solid_io.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

// "depth-2.tiff" gives "depth.tiff", so that saving again and again does not lengthen the name.
fs::path WithoutNumber(const fs::path& name) {
  std::string stem = name.stem().string();
  const std::size_t dash = stem.rfind('-');
  const bool is_numbered = dash != stem.npos && dash > 0 && dash + 1 < stem.size() &&
                           stem.find_first_not_of("0123456789", dash + 1) == stem.npos;
  if (!is_numbered) return name;
  fs::path base = name;
  return base.replace_filename(stem.substr(0, dash) + name.extension().string());
}

bool IsSamePlace(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return !a.empty() && fs::equivalent(a, b, ignored);
}

// Does the file hold what is in memory? One that cannot be read does not.
template <class Part, class Read, class Compare>
bool Holds(const fs::path& file, const Part& part, const Read& read, const Compare& is_equal) {
  try {
    return is_equal(read(file), part);
  } catch (const Error&) {
    return false;
  }
}

bool HoldsPanorama(const fs::path& file, const ColourImage& panorama) {
  return Holds(file, panorama, ReadColourImage, [](const auto& a, const auto& b) {
    return a.width == b.width && a.height == b.height && a.rgb == b.rgb;
  });
}

bool IsSameDepth(const DepthMap& a, const DepthMap& b) {
  return a.width == b.width && a.height == b.height &&
         std::memcmp(a.relief.data(), b.relief.data(), a.relief.size() * sizeof(float)) == 0;
}

bool HoldsDepth(const fs::path& file, const DepthMap& depth) {
  return Holds(file, depth, ReadDepthMap, IsSameDepth);
}

bool HoldsSigma(const fs::path& file, const DepthMap& sigma) {
  return Holds(file, sigma, ReadDepthSigma, IsSameDepth);
}

bool HoldsOrigins(const fs::path& file, const OriginMap& origins) {
  return Holds(file, origins, ReadOriginMap, [](const auto& a, const auto& b) {
    return a.width == b.width && a.height == b.height && a.origin == b.origin;
  });
}

bool HoldsSurface(const fs::path& file, const SurfaceMesh& surface) {
  const auto read = [](const fs::path& path) { return ReadSurface(path, 1.0); };
  return Holds(file, surface, read, [](const auto& a, const auto& b) {
    return a.vertices == b.vertices && a.triangles == b.triangles;
  });
}

// The picture's file without metadata; nothing where it has to be written anew from its pixels: in
// other formats, and where metadata say how the pixels are turned.
std::optional<std::string> CleanCopy(const fs::path& source, const ColourImage& panorama) {
  if (source.empty()) return std::nullopt;
  std::optional<std::string> clean = PictureWithoutMetadata(ReadWholeFile(source));
  if (!clean) return std::nullopt;
  const TemporaryFolder folder;
  WriteAtomically(folder.path() / "clean", *clean);
  if (!HoldsPanorama(folder.path() / "clean", panorama)) return std::nullopt;
  return clean;
}

class Saving {
 public:
  // `place`: the folder, or the archive that `folder` will be packed into.
  Saving(const Document& document, const fs::path& folder, const fs::path& place,
         const SaveOptions& options)
      : before_(document),
        after_(document),
        folder_(folder),
        options_(options),
        is_in_place_(IsSamePlace(document.folder, folder)),
        is_copy_(!IsSamePlace(document.folder, place)),
        is_handed_on_(IsArchive(place) || (is_copy_ && !document.folder.empty())),
        writer_(folder, KnownFiles()) {}

  Document Run() {
    after_.folder = folder_;
    after_.files.clear();
    SavePanorama();
    SaveDepth();
    for (std::size_t i = 0; i < after_.scene.tissues.size(); ++i) SaveTissue(i);
    SaveFootage();
    SaveLens();
    SaveExerciseFiles();
    // Before the sort, so that the files of the backup are kept.
    if (options_.keeps_backup) KeepBackup(folder_);
    const WrittenFiles unused = SortWrittenFiles();
    SaveExtensions();
    if (!unused.empty()) writer_.NoteUnfinished();
    WriteScene(folder_ / "scene.json", after_.scene);
    writer_.Keep();
    // The new scene is in place: what it does not name any more may go.
    std::error_code ignored;
    for (const auto& [name, mark] : unused)
      if (FingerprintOfFile(folder_ / name) == mark) fs::remove(folder_ / name, ignored);
    RemoveUnfinishedSave(folder_);
    return after_;
  }

 private:
  WrittenFiles KnownFiles() const {
    if (!is_in_place_ || options_.keeps_all_files) return {};
    RemoveLeftovers(folder_, options_.needed_files);
    return WrittenFilesOf(folder_);
  }

  // The file that this part was read from or written to, or nothing.
  fs::path SourceOf(const fs::path& name, const std::shared_ptr<const void>& part) const {
    const auto entry = before_.files.find(name.generic_string());
    std::error_code ignored;
    if (name.empty() || entry == before_.files.end() || entry->second.part.lock() != part ||
        !fs::is_regular_file(entry->second.file, ignored))
      return {};
    if (!before_.folder.empty() && !IsArchive(before_.folder) &&
        IsSamePlace(before_.folder / name, entry->second.file) && is_copy_)
      RequireInFolder(before_.folder, name);
    return entry->second.file;
  }

  // The part lies in the folder already, unchanged since it was read or written.
  bool IsThere(const fs::path& name, const std::shared_ptr<const void>& part) const {
    const fs::path source = SourceOf(name, part);
    if (source.empty() || !IsSamePlace(source, folder_ / name)) return false;
    const std::string& mark = before_.files.at(name.generic_string()).fingerprint;
    return !mark.empty() && mark == FingerprintOf(ReadWholeFile(source));
  }

  void Note(const fs::path& name, const std::shared_ptr<const void>& part) {
    const auto written = writer_.files().find(name.generic_string());
    after_.files[name.generic_string()] = {fs::absolute(folder_ / name), part,
                                           written != writer_.files().end()
                                               ? written->second
                                               : FingerprintOf(ReadWholeFile(folder_ / name))};
  }

  // The name to write a part under: its own, or that of the part which it takes the place of.
  fs::path FreshName(const fs::path& name, const fs::path& usual,
                     const std::shared_ptr<const void>& part) const {
    if (name.empty()) return usual;
    const auto entry = before_.files.find(name.generic_string());
    const bool is_same_part = entry != before_.files.end() && entry->second.part.lock() == part;
    return is_same_part ? name : WithoutNumber(name);
  }

  // Leaves `name` where the part lies under it, else has `write` give it a new one.
  template <class Part, class Holds, class WritePart>
  void SavePart(fs::path& name, const std::shared_ptr<const Part>& part, const Holds& holds,
                const WritePart& write) {
    const bool is_there =
        IsThere(name, part) || (is_in_place_ && !name.empty() && holds(folder_ / name, *part));
    if (!is_there) name = write();
    Note(name, part);
  }

  void SavePanorama() {
    if (!after_.panorama || after_.panorama->empty())
      throw Error(Code::kBadScene,
                  "there is no panorama yet, so there is no scene to save; "
                  "import one first");
    fs::path& name = after_.scene.backdrop.panorama;
    const ColourImage& panorama = *after_.panorama;
    SavePart(name, after_.panorama, HoldsPanorama, [&] {
      fs::path fresh = FreshName(name, "panorama.png", after_.panorama);
      if (const auto clean = CleanCopy(SourceOf(name, after_.panorama), panorama))
        return writer_.Write(fresh, [&](const fs::path& to) { WriteAtomically(to, *clean); });
      // Written from memory it must lose nothing, so not as JPEG.
      if (!IsOneOf(LowerExtension(fresh), {".png", ".tif", ".tiff", ".bmp"}))
        fresh.replace_extension(".png");
      return writer_.Write(fresh, [&](const fs::path& to) { WriteColourImage(to, panorama); });
    });
  }

  void SaveDepth() {
    Backdrop& backdrop = after_.scene.backdrop;
    if (!after_.depth || after_.depth->empty()) {
      SetDepth(after_, nullptr);  // nothing is left that its error or origins describe
      after_.unmended = {};
      backdrop.depth.clear();
      return;
    }
    RequireSameSize(*after_.panorama, *after_.depth, folder_ / backdrop.depth);
    const auto write_depth = [this](const fs::path& to, const DepthMap& map) {
      WriteDepthMap(to, map, options_.packs_quickly ? DepthPacking::kQuick : DepthPacking::kSmall);
    };
    SaveMap(backdrop.depth, "depth.tiff", after_.depth, HoldsDepth, write_depth);
    if (after_.depth_sigma)
      RequireSameSize(*after_.depth, *after_.depth_sigma, folder_ / backdrop.depth_sigma);
    SaveMap(backdrop.depth_sigma, "depth-sigma.tiff", after_.depth_sigma, HoldsSigma, write_depth);
    if (after_.depth_origin)
      RequireSameSize(*after_.depth, *after_.depth_origin, folder_ / backdrop.depth_origin);
    SaveMap(backdrop.depth_origin, "depth-origin.png", after_.depth_origin, HoldsOrigins,
            WriteOriginMap);
    UnmendedDepth& unmended = after_.unmended;
    if (!after_.is_depth_imported || !after_.depth_strokes) unmended = {};
    SaveMap(unmended.depth_file, "depth-unmended.tiff", unmended.depth, HoldsDepth, write_depth);
    SaveMap(unmended.sigma_file, "depth-sigma-unmended.tiff", unmended.sigma, HoldsSigma,
            write_depth);
    SaveMap(unmended.origin_file, "depth-origin-unmended.png", unmended.origin, HoldsOrigins,
            WriteOriginMap);
  }

  // Writes a map of the backdrop as a file of the kind of `usual`; without a map there is no name.
  template <class Map, class WriteMap>
  void SaveMap(fs::path& name, const fs::path& usual, const std::shared_ptr<const Map>& map,
               bool (*holds)(const fs::path&, const Map&), const WriteMap& write) {
    if (!map) {
      name.clear();
      return;
    }
    SavePart(name, map, holds, [&] {
      fs::path fresh = FreshName(name, usual, map);
      const bool is_tiff = fresh.extension() == ".tif" && usual.extension() == ".tiff";
      if (!is_tiff) fresh.replace_extension(usual.extension());
      SourceOf(name, map);  // refuses a link that leaves the folder
      return writer_.Write(fresh, [&](const fs::path& to) { write(to, *map); });
    });
  }

  void SaveTissue(std::size_t i) {
    Tissue& tissue = after_.scene.tissues[i];
    if (i >= after_.surfaces.size() || !after_.surfaces[i])
      throw Error(Code::kBadScene, fmt::format("tissue \"{}\" has no surface; import it again or "
                                               "remove the tissue",
                                               tissue.name));
    const auto& surface = after_.surfaces[i];
    if (IsSolidFile(tissue.surface))
      SaveFromFile(fmt::format("tissues[{}].surface", i), tissue.surface, surface, ReadSolid,
                   WriteSolid);
    else
      SavePart(tissue.surface, surface, HoldsSurface, [&] {
        fs::path fresh =
            FreshName(tissue.surface, FileNameFrom(tissue.name, "tissue") + ".ply", surface);
        // STL rounds to 32 bits and OFF and VTP are read only, so memory is written as PLY.
        if (!IsOneOf(LowerExtension(fresh), {".ply", ".obj"})) fresh.replace_extension(".ply");
        SourceOf(tissue.surface, surface);  // refuses a link that leaves the folder
        return writer_.Write(fresh, [&](const fs::path& to) { WriteSurface(to, *surface); });
      });
    if (!tissue.mesh.empty())
      SaveFromFile(
          fmt::format("tissues[{}].mesh", i), tissue.mesh, nullptr,
          [](const fs::path& source) { return ReadTetMesh(source); }, WriteTetMesh);
  }

  void SaveLens() {
    fs::path& name = after_.scene.scope.lens;
    if (name.empty()) return;
    if (!after_.lens) return SaveFromFile("scope.lens", name, nullptr, ReadLens, WriteLens);
    if (!IsThere(name, nullptr)) {
      SourceOf(name, nullptr);  // refuses a link that leaves the folder
      const fs::path fresh = FreshName(name, "lens.json", nullptr);
      name = writer_.Write(fresh, [&](const fs::path& to) { WriteLens(to, *after_.lens); });
    }
    Note(name, nullptr);
  }

  // Pictures without what they say about a camera, and recordings as they are: they name nobody.
  void SaveExerciseFiles() {
    const auto clean = [](const fs::path& source) {
      const auto bytes = CleanCopy(source, ReadColourImage(source));
      return bytes ? *bytes : ReadWholeFile(source);
    };
    const auto as_it_is = [](const fs::path& source) { return ReadWholeFile(source); };
    const auto write = [](const fs::path& to, const std::string& bytes) {
      WriteAtomically(to, bytes);
    };
    for (const ExerciseFile& file : ExerciseFilesOf(after_.scene))
      if (file.is_picture)
        SaveFromFile(file.key, *file.name, nullptr, clean, write);
      else
        SaveFromFile(file.key, *file.name, nullptr, as_it_is, write);
  }

  void SaveFootage() {
    fs::path& name = after_.scene.backdrop.footage;
    if (!after_.footage) return name.clear();
    const FootageRecord record =
        is_handed_on_ ? WithoutNames(*after_.footage) : BesideScene(*after_.footage, folder_);
    const auto holds = [&](const fs::path& file, const FootageRecord&) {
      return Holds(file, record, ReadFootage, std::equal_to<>());
    };
    SavePart(name, after_.footage, holds, [&] {
      const fs::path fresh = FreshName(name, "footage.json", after_.footage);
      SourceOf(name, after_.footage);  // refuses a link that leaves the folder
      return writer_.Write(
          fresh, [&](const fs::path& to) { WriteAtomically(to, JsonFromFootage(record)); });
    });
  }

  // Assets that are not in memory lie where `files` says, or in the folder of the document. `part`
  // is what was made of the file, such as the surface of a solid; null: nothing. A copy
  // is read and written anew, so that it holds what the asset is and nothing else.
  template <class Read, class WritePart>
  void SaveFromFile(const std::string& key, fs::path& name, const std::shared_ptr<const void>& part,
                    const Read& read, const WritePart& write) {
    fs::path source = SourceOf(name, part);
    std::error_code ignored;
    if (source.empty() && !before_.folder.empty()) {
      source = before_.folder / name;
      if (is_copy_ && fs::is_regular_file(source, ignored)) RequireInFolder(before_.folder, name);
    }
    if (source.empty() || !fs::is_regular_file(source, ignored))
      throw Error(Code::kBadScene,
                  fmt::format("{} names \"{}\", which can no longer be found; make "
                              "it again or remove it",
                              key, name.generic_string()));
    if (!IsSamePlace(source, folder_ / name)) {
      const auto held = read(source);
      name = writer_.Write(name, [&](const fs::path& to) { write(to, held); });
    }
    Note(name, part);
  }

  // Puts into `written_` what this scene goes on to answer for; returns what may be removed.
  WrittenFiles SortWrittenFiles() {
    WrittenFiles unused;
    for (const auto& [name, mark] : writer_.files()) {
      if (!IsInFolder(folder_, name)) continue;
      if (FingerprintOfFile(folder_ / name) != mark) continue;  // gone, or somebody else's by now
      const bool is_kept =
          after_.files.contains(name) ||
          options_.needed_files.contains(fs::absolute(folder_ / name).lexically_normal()) ||
          IsNamedByAnotherFile(folder_, name);
      (is_kept ? written_ : unused)[name] = mark;
    }
    return unused;
  }

  void SaveExtensions() {
    auto& extensions = after_.scene.extensions;
    // Keys of other tools stay in this scene; a copy that is handed on does not carry them.
    if (is_copy_)
      std::erase_if(extensions, [](const auto& entry) { return entry.first != kPlacingKey; });
    PutDocumentKeys(after_);
    extensions.erase(kWrittenFilesKey);
    if (!written_.empty()) extensions[kWrittenFilesKey] = JsonFromWrittenFiles(written_);
  }

  const Document& before_;
  Document after_;
  fs::path folder_;
  const SaveOptions& options_;
  bool is_in_place_, is_copy_;
  bool is_handed_on_;  // to where names of clips do not belong
  AssetWriter writer_;
  WrittenFiles written_;
};

// Returns where a new folder of this name will be; nothing where something has the name already,
// even a link that leads nowhere, or where it cannot be made.
std::optional<fs::path> PlaceOfNew(const fs::path& folder) {
  const fs::path plain = folder.has_filename() ? folder : folder.parent_path();
  std::error_code fault;
  if (plain.empty() || fs::exists(fs::symlink_status(plain, fault))) return std::nullopt;
  const fs::path above = fs::canonical(plain.has_parent_path() ? plain.parent_path() : ".", fault);
  if (fault || !fs::is_directory(above, fault)) return std::nullopt;
  return above / plain.filename();
}

// A new folder appears whole or not at all, also where this program is killed meanwhile.
Document SaveInNewFolder(const Document& document, const fs::path& folder, const fs::path& place,
                         const SaveOptions& options) {
  PartialFolder fresh(place);
  arthro::RemoveLeftovers(fresh.beside().parent_path());
  try {
    Document saved = Saving(document, fresh.beside(), folder, options).Run();
    fresh.PutInPlaceAsNew();
    saved.folder = folder;
    for (auto& [name, held] : saved.files) held.file = fs::absolute(folder / name);
    return saved;
  } catch (const Error& error) {
    // Said of the folder that was asked for.
    const fs::path within = error.file().lexically_relative(fresh.beside());
    if (within.empty() || *within.begin() == "..") throw;
    throw Error(error.code(), error.sentence(), within == "." ? folder : folder / within);
  }
}

}  // namespace

void PutDocumentKeys(Document& document) {
  auto& extensions = document.scene.extensions;
  extensions[kDepthOptionsKey] = OptionsText(document.depth_options);
  extensions.erase(kDepthStrokesKey);
  if (document.depth_strokes) extensions[kDepthStrokesKey] = StrokesText(*document.depth_strokes);
  extensions.erase(kDepthMadeKey);
  if (document.depth && !document.depth->empty() && !document.is_depth_imported)
    extensions[kDepthMadeKey] = DepthFingerprint(*document.depth);
  PutUnmendedKey(document);
}

void PutUnmendedKey(Document& document) {
  auto& extensions = document.scene.extensions;
  extensions.erase(kUnmendedDepthKey);
  const UnmendedDepth& unmended = document.unmended;
  if (!unmended.depth) return;
  nlohmann::json files = nlohmann::json::object();
  for (const auto& [word, file] :
       {std::pair("depth", &unmended.depth_file), std::pair("sigma", &unmended.sigma_file),
        std::pair("origin", &unmended.origin_file)})
    if (!file->empty()) files[word] = file->generic_string();
  extensions[kUnmendedDepthKey] = files.dump();
}

std::string DepthFingerprint(const DepthMap& depth) {
  const std::string_view bytes(reinterpret_cast<const char*>(depth.relief.data()),
                               depth.relief.size() * sizeof(float));
  return nlohmann::json(fmt::format("{}x{}-{}", depth.width, depth.height, FingerprintOf(bytes)))
      .dump();
}

Document SaveDocument(const Document& document, const fs::path& folder,
                      const SaveOptions& options) {
  if (!IsArchive(folder)) {
    const std::optional<fs::path> place = PlaceOfNew(folder);
    Document saved = place ? SaveInNewFolder(document, folder, *place, options)
                           : Saving(document, folder, folder, options).Run();
    saved.unpacked = nullptr;
    return saved;
  }
  // Beside the archive rather than in it lie the files that the next save copies from.
  const auto unpacked = std::make_shared<const TemporaryFolder>();
  SaveOptions into_archive = options;
  into_archive.keeps_backup = false;
  Document saved = Saving(document, unpacked->path(), folder, into_archive).Run();
  if (options.keeps_backup) KeepBackup(folder);
  PackScene(unpacked->path(), folder);
  saved.folder = folder;
  saved.unpacked = unpacked;
  return saved;
}

}  // namespace arthro::authoring
