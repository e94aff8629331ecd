#include "authoring/project/document_io.h"

#include <algorithm>
#include <cmath>

#include "authoring/project/document_extensions.h"
#include "authoring/project/file_ending.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/fingerprint.h"
#include "simulation/core/option_fields.h"
#include "simulation/core/units.h"
#include "simulation/scene/files/archive_io.h"
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
  document.scene.instruments.push_back({});
  document.files[document.scene.backdrop.panorama.generic_string()] = {
      fs::absolute(picture), document.panorama, {}};
  return document;
}

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
  // Options of another version are no reason not to open a scene; they are a convenience.
  const auto options = document.scene.extensions.find(kDepthOptionsKey);
  if (options != document.scene.extensions.end()) try {
      ReadOptionsText(options->second, {}, document.depth_options);
    } catch (const Error&) {
      document.depth_options = {};
    }
  return document;
}

}  // namespace arthro::authoring
