// A scene in memory: its values, its pictures and surfaces, and where its files lie. Sessions,
// pictures and checks are built from it; the author's document adds to it. Lengths in m.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "simulation/core/error.h"
#include "simulation/scene/image.h"
#include "simulation/scene/lens.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/scene.h"

namespace arthro {

class TemporaryFolder;

// Heavy parts are shared and never changed in place, because every step of the undo history holds
// a complete scene. An edit puts a new part in place of the old one.
using SharedSurface = std::shared_ptr<const SurfaceMesh>;

template <class Part>
std::shared_ptr<const Part> Share(Part part) {
  return std::make_shared<const Part>(std::move(part));
}

// The part, or an empty one where there is none.
template <class Part>
const Part& OrEmpty(const std::shared_ptr<const Part>& part) {
  static const Part kEmpty;
  return part ? *part : kEmpty;
}

// A file that holds an asset of the scene. `part` is the part in memory that was read from or
// written to it, and is empty for assets that are only copied (lens, tetrahedra). A file whose part
// is no longer the one in the scene is out of date.
struct AssetFile {
  std::filesystem::path file;  // absolute
  std::weak_ptr<const void> part;
  std::string fingerprint;  // fingerprint of the file (core/fingerprint.h); empty: unknown
};

struct LoadedScene {
  // Compiled once, in loaded_scene.cpp, since most sources copy scenes.
  LoadedScene();
  LoadedScene(const LoadedScene&);
  LoadedScene(LoadedScene&&) noexcept;
  LoadedScene& operator=(const LoadedScene&);
  LoadedScene& operator=(LoadedScene&&) noexcept;
  ~LoadedScene();

  Scene scene;
  std::shared_ptr<const ColourImage> panorama;  // null: none yet
  std::shared_ptr<const DepthMap> depth;        // same size as the panorama; null: a bare sphere
  // Standard error of the depth map, m, and origin of each depth; same size; null: not known.
  std::shared_ptr<const DepthMap> depth_sigma;
  std::shared_ptr<const OriginMap> depth_origin;
  std::vector<SharedSurface> surfaces;  // one per tissue, in its own frame; null: none
  std::optional<Lens> lens;             // lens of the scope; none: equisolid
  // Folder or .arthro archive in which the scene is saved; empty until it is.
  std::filesystem::path folder;
  // Files of the assets by the name that the scene uses. Code that adds tetrahedra or a lens enters
  // its file here.
  std::map<std::string, AssetFile> files;
  std::shared_ptr<const TemporaryFolder> unpacked;  // keeps the files of an opened archive
};

// Replaces the depth map, also by none (null). The standard error and the origins of another depth
// map are removed with it.
void SetDepth(LoadedScene& loaded, std::shared_ptr<const DepthMap> depth);

// File of an asset by the name that the scene uses.
std::filesystem::path FileOf(const LoadedScene& loaded, const std::filesystem::path& name);

// The same fault; for a scene from an archive it names the archive instead of the folder that the
// archive was unpacked into.
Error NamedByScene(const Error& fault, const LoadedScene& loaded);

}  // namespace arthro
