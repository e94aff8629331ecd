// A document with a level relief, 10 mm over the sphere, and nothing else.
#pragma once

#include "app/files/scene_files.h"
#include "authoring/project/document.h"

namespace arthro::test {

inline authoring::Document PlainDocument() {
  authoring::Document document = app::NewDocument();
  document.panorama = Share(ColourImage(400, 300));
  document.scene.backdrop.projection.type = ProjectionType::kEquirectangular;
  document.scene.backdrop.projection.centre_px = {199.5, 149.5};
  document.scene.backdrop.projection.px_per_deg = 2;
  document.depth = Share(DepthMap(400, 300, 0.01f));
  return document;
}

}  // namespace arthro::test
