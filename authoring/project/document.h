// What an author works on: a scene with its pictures and surfaces in memory. A plain value that is
// cheap to copy, since the big parts are shared and never changed in place: an edit makes a new
// document with a new part. shared_ptr because many steps of the history hold the same part.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "authoring/depth/depth_options.h"
#include "simulation/scene/image.h"
#include "simulation/scene/lens.h"
#include "simulation/scene/scene.h"
#include "simulation/scene/surface_mesh.h"

namespace arthro::authoring {

// A file that holds an asset of the document. `part` is the part in memory that was read from or
// written to it (nothing for assets that are only ever copied: lens, tetrahedra); once the document
// holds another part under that name, the file no longer counts.
struct AssetFile {
  std::filesystem::path file;  // absolute
  std::weak_ptr<const void> part;
  std::string fingerprint;  // of the file (core/fingerprint.h); empty: not known
};

struct Document {
  Scene scene;
  DepthOptions depth_options;
  std::shared_ptr<const ColourImage> panorama;  // never null once there is a picture
  std::shared_ptr<const DepthMap> depth;        // null: a bare sphere
  bool is_depth_imported = false;               // brought along, not made from panorama and options
  std::vector<std::shared_ptr<const SurfaceMesh>> surfaces;  // one a tissue, own frame, m
  std::optional<Lens> lens;                                  // of the scope; nothing: equisolid
  // Where it is saved: a scene's folder or an .arthro archive; empty until it is.
  std::filesystem::path folder;
  // Where the bytes of the scene's assets lie, by the name that the scene uses. document_io.h
  // fills it; whoever adds a tissue's tetrahedra or a lens names its file here.
  std::map<std::string, AssetFile> files;
  std::shared_ptr<const void> unpacked;  // holds the files of an opened archive
};

}  // namespace arthro::authoring
