#include "authoring/project/document_io.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "authoring/project/asset_writer.h"
#include "simulation/core/error.h"
#include "simulation/core/json_text.h"
#include "simulation/core/options_json.h"
#include "simulation/core/units.h"
#include "simulation/scene/archive_io.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/mesh_io.h"
#include "simulation/scene/scene_io.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

// Where scene.json keeps how its depth was made, for the next time it is opened here.
constexpr const char* kDepthOptionsKey = "x-depth-options";

std::string LowerExtension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

bool IsOneOf(const std::string& word, std::initializer_list<const char*> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// A file name from a person's words: "Medial meniscus" gives "medial-meniscus".
std::string FileNameOf(const std::string& words) {
  std::string name;
  for (const unsigned char letter : words) {
    if (std::isalnum(letter))
      name += static_cast<char>(std::tolower(letter));
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name.empty() ? "tissue" : name;
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

bool HoldsDepth(const fs::path& file, const DepthMap& depth) {
  return Holds(file, depth, ReadDepthMap, [](const auto& a, const auto& b) {
    return a.width == b.width && a.height == b.height &&
           std::memcmp(a.relief.data(), b.relief.data(), a.relief.size() * sizeof(float)) == 0;
  });
}

bool HoldsSurface(const fs::path& file, const SurfaceMesh& surface) {
  const auto read = [](const fs::path& path) { return ReadSurface(path, 1.0); };
  return Holds(file, surface, read, [](const auto& a, const auto& b) {
    return a.vertices == b.vertices && a.triangles == b.triangles;
  });
}

class Saving {
 public:
  Saving(const Document& document, const fs::path& folder)
      : before_(document), after_(document), folder_(folder), writer_(folder) {}

  Document Run() {
    after_.folder = folder_;
    after_.files.clear();
    SavePanorama();
    SaveDepth();
    for (std::size_t i = 0; i < after_.scene.tissues.size(); ++i) SaveTissue(i);
    if (!after_.scene.scope.lens.empty()) CopyOnly("scope.lens", after_.scene.scope.lens);
    after_.scene.extensions[kDepthOptionsKey] = JsonFromOptions(after_.depth_options).dump();
    WriteScene(folder_ / "scene.json", after_.scene);
    writer_.Keep();
    return after_;
  }

 private:
  // The file that holds exactly this part, or nothing.
  fs::path SourceOf(const fs::path& name, const std::shared_ptr<const void>& part) const {
    const auto entry = before_.files.find(name.generic_string());
    std::error_code ignored;
    if (entry == before_.files.end() || entry->second.part.lock() != part ||
        !fs::is_regular_file(entry->second.file, ignored))
      return {};
    return entry->second.file;
  }

  void Note(const fs::path& name, const std::shared_ptr<const void>& part) {
    after_.files[name.generic_string()] = {fs::absolute(folder_ / name), part};
  }

  // From its file where there is one, else from memory under `fresh_name`.
  template <class Part, class IsSame, class WritePart>
  void SavePart(fs::path& name, const fs::path& fresh_name, const std::shared_ptr<const Part>& part,
                const IsSame& is_same, const WritePart& write) {
    const fs::path source = name.empty() ? fs::path() : SourceOf(name, part);
    if (!source.empty())
      name = writer_.Copy(source, name);
    else
      name = writer_.Write(
          fresh_name, [&](const fs::path& there) { return is_same(there, *part); },
          [&](const fs::path& target) { write(target, *part); });
    Note(name, part);
  }

  void SavePanorama() {
    if (!after_.panorama || after_.panorama->empty())
      throw Error(Code::kBadScene,
                  "there is no panorama yet, so there is no scene to save; "
                  "import one first");
    fs::path& name = after_.scene.backdrop.panorama;
    fs::path fresh = name.empty() ? "panorama.png" : name;
    // Written from memory it must lose nothing, so not as JPEG — unless that is what lies there.
    if (!IsOneOf(LowerExtension(fresh), {".png", ".tif", ".tiff", ".bmp"}) &&
        !HoldsPanorama(folder_ / fresh, *after_.panorama))
      fresh.replace_extension(".png");
    SavePart(name, fresh, after_.panorama, HoldsPanorama, WriteColourImage);
  }

  void SaveDepth() {
    fs::path& name = after_.scene.backdrop.depth;
    if (!after_.depth || after_.depth->empty()) {
      name.clear();
      return;
    }
    RequireSameSize(*after_.panorama, *after_.depth, folder_ / name);
    fs::path fresh = name.empty() ? "depth.tiff" : name;
    if (!IsOneOf(fresh.extension().string(), {".tif", ".tiff"})) fresh.replace_extension(".tiff");
    SavePart(name, fresh, after_.depth, HoldsDepth, WriteDepthMap);
  }

  void SaveTissue(std::size_t i) {
    Tissue& tissue = after_.scene.tissues[i];
    if (i >= after_.surfaces.size() || !after_.surfaces[i])
      throw Error(Code::kBadScene, fmt::format("tissue \"{}\" has no surface; import it again or "
                                               "remove the tissue",
                                               tissue.name));
    fs::path fresh =
        tissue.surface.empty() ? fs::path(FileNameOf(tissue.name) + ".ply") : tissue.surface;
    // STL rounds to 32 bits and OFF and VTP are read only, so memory is written as PLY.
    if (!IsOneOf(LowerExtension(fresh), {".ply", ".obj"}) &&
        !HoldsSurface(folder_ / fresh, *after_.surfaces[i]))
      fresh.replace_extension(".ply");
    SavePart(tissue.surface, fresh, after_.surfaces[i], HoldsSurface, WriteSurface);
    if (!tissue.mesh.empty()) CopyOnly(fmt::format("tissues[{}].mesh", i), tissue.mesh);
  }

  // Assets that are not in memory lie where `files` says, or in the folder of the document.
  void CopyOnly(const std::string& key, fs::path& name) {
    fs::path source = SourceOf(name, nullptr);
    std::error_code ignored;
    if (source.empty() && !before_.folder.empty()) source = before_.folder / name;
    if (source.empty() || !fs::is_regular_file(source, ignored))
      throw Error(Code::kBadScene,
                  fmt::format("{} names \"{}\", which can no longer be found; make "
                              "it again or remove it",
                              key, name.generic_string()));
    name = writer_.Copy(source, name);
    Note(name, nullptr);
  }

  const Document& before_;
  Document after_;
  fs::path folder_;
  AssetWriter writer_;
};

}  // namespace

Projection GuessProjection(int width, int height) {
  constexpr double kHalfWidthDeg = 52.5;
  Projection projection;
  projection.type = ProjectionType::kGnomonic;
  projection.centre_px = {(width - 1) / 2.0, (height - 1) / 2.0};
  projection.focal_px = 0.5 * std::max(width, height) / std::tan(RadiansFromDegrees(kHalfWidthDeg));
  return projection;
}

Document DocumentFromPanorama(const fs::path& picture) {
  Document document;
  document.panorama = std::make_shared<const ColourImage>(ReadColourImage(picture));
  document.scene.title = picture.stem().string();
  document.scene.backdrop.panorama = "panorama" + LowerExtension(picture);
  document.scene.backdrop.projection =
      GuessProjection(document.panorama->width, document.panorama->height);
  document.scene.instruments.push_back({});
  document.files[document.scene.backdrop.panorama.generic_string()] = {fs::absolute(picture),
                                                                       document.panorama};
  return document;
}

Document OpenDocument(const fs::path& file) {
  if (IsOneOf(LowerExtension(file), {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp"}) &&
      !fs::is_directory(file))
    return DocumentFromPanorama(file);
  LoadedScene loaded = LoadScene(file);
  Document document;
  document.scene = std::move(loaded.scene);
  document.folder = IsArchive(file) ? file : loaded.folder;
  document.unpacked = loaded.unpacked;
  document.lens = loaded.lens;
  const auto note = [&](const fs::path& name, const std::shared_ptr<const void>& part) {
    if (!name.empty())
      document.files[name.generic_string()] = {fs::absolute(loaded.folder / name), part};
  };
  document.panorama = std::make_shared<const ColourImage>(std::move(loaded.panorama));
  note(document.scene.backdrop.panorama, document.panorama);
  if (!loaded.depth.empty())
    document.depth = std::make_shared<const DepthMap>(std::move(loaded.depth));
  note(document.scene.backdrop.depth, document.depth);
  for (std::size_t i = 0; i < loaded.surfaces.size(); ++i) {
    document.surfaces.push_back(std::make_shared<const SurfaceMesh>(std::move(loaded.surfaces[i])));
    note(document.scene.tissues[i].surface, document.surfaces[i]);
    note(document.scene.tissues[i].mesh, nullptr);
  }
  note(document.scene.scope.lens, nullptr);
  // Options of another version are no reason not to open a scene; they are a convenience.
  const auto options = document.scene.extensions.find(kDepthOptionsKey);
  if (options != document.scene.extensions.end()) try {
      document.depth_options =
          OptionsFromJson<DepthOptions>(ParseJson(options->second, Code::kBadData));
    } catch (const Error&) {
      document.depth_options = {};
    }
  return document;
}

Document SaveDocument(const Document& document, const fs::path& folder) {
  if (!IsArchive(folder)) {
    Document saved = Saving(document, folder).Run();
    saved.unpacked = nullptr;
    return saved;
  }
  // Beside the archive rather than in it lie the files that the next save copies from.
  const auto unpacked = std::make_shared<const TemporaryFolder>();
  Document saved = Saving(document, unpacked->path()).Run();
  PackScene(unpacked->path(), folder);
  saved.folder = folder;
  saved.unpacked = unpacked;
  return saved;
}

}  // namespace arthro::authoring
