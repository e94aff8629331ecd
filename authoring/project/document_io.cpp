#include "authoring/project/document_io.h"

#include <algorithm>
#include <cmath>

#include "authoring/depth/strokes/depth_strokes_io.h"
#include "authoring/project/document_extensions.h"
#include "authoring/project/every_instrument.h"
#include "authoring/project/files/file_ending.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/fingerprint.h"
#include "simulation/core/option_fields.h"
#include "simulation/core/units.h"
#include "simulation/scene/files/archive_io.h"
#include "simulation/scene/files/scene_files.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"

namespace arthro::authoring {

namespace fs = std::filesystem;

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
  document.scene.instruments = EveryInstrument();
  document.files[document.scene.backdrop.panorama.generic_string()] = {
      fs::absolute(picture), document.panorama, {}};
  return document;
}

namespace {

// The imported map before its strokes. Where it cannot be read the map that is shown holds its
// strokes for good, as in scenes of earlier versions.
void ReadUnmended(Document& document) {
  if (!document.is_depth_imported || !document.depth_strokes) return;
  const auto names = UnmendedFilesOf(document.scene);
  const auto read = [&](const char* word, fs::path& name, auto& map, const auto& from) {
    const auto at = names.find(word);
    if (at == names.end()) return;
    name = at->second;
    map = Share(from(FileOf(document, name)));
    RequireSameSize(*document.depth, *map, FileOf(document, name));
  };
  UnmendedDepth unmended;
  try {
    read("depth", unmended.depth_file, unmended.depth, ReadDepthMap);
    read("sigma", unmended.sigma_file, unmended.sigma, ReadDepthSigma);
    read("origin", unmended.origin_file, unmended.origin, ReadOriginMap);
  } catch (const Error&) {
    unmended = {};
  }
  if (!unmended.depth) {
    document.depth_strokes = nullptr;
    return;
  }
  const auto note = [&](const fs::path& name, const std::shared_ptr<const void>& part) {
    if (part) document.files[name.generic_string()].part = part;
  };
  note(unmended.depth_file, unmended.depth);
  note(unmended.sigma_file, unmended.sigma);
  note(unmended.origin_file, unmended.origin);
  document.unmended = std::move(unmended);
}

}  // namespace

Document OpenDocument(const fs::path& file) {
  if (IsOneOf(LowerExtension(file), {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp"}) &&
      !fs::is_directory(file))
    return DocumentFromPanorama(file);
  Document document;
  static_cast<LoadedScene&>(document) = LoadScene(file);
  for (auto& [name, asset] : document.files)
    asset.fingerprint = FingerprintOf(ReadWholeFile(asset.file));
  const auto made = document.scene.extensions.find(kDepthMadeKey);
  document.is_depth_imported =
      document.depth && (made == document.scene.extensions.end() ||
                         made->second != DepthFingerprint(*document.depth));
  if (const fs::path& name = document.scene.backdrop.footage; !name.empty()) {
    document.footage = std::make_shared<const FootageRecord>(ReadFootage(FileOf(document, name)));
    document.files[name.generic_string()].part = document.footage;
  }
  // Options of another version are no reason not to open a scene; they are a convenience.
  const auto options = document.scene.extensions.find(kDepthOptionsKey);
  if (options != document.scene.extensions.end()) try {
      ReadOptionsText(options->second, {}, document.depth_options);
    } catch (const Error&) {
      document.depth_options = {};
    }
  const auto strokes = document.scene.extensions.find(kDepthStrokesKey);
  if (strokes != document.scene.extensions.end()) try {
      document.depth_strokes = Share(StrokesFromText(strokes->second, {}));
    } catch (const Error&) {
      document.depth_strokes = nullptr;
    }
  ReadUnmended(document);
  return document;
}

}  // namespace arthro::authoring
