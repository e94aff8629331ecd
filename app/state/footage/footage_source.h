// The record of a panorama that was just made, for the scene that takes it over
// (authoring/project/footage_record.h).
#pragma once

#include "authoring/panorama/make_panorama.h"
#include "authoring/project/document.h"

namespace arthro::app {

// Fingerprint of a clip that could not be read.
inline constexpr const char* kUnknownClip = "unknown";

// Reads each clip for its fingerprint; a clip that cannot be read has none.
authoring::FootageRecord RecordOf(const authoring::PanoramaRequest& request,
                                  const authoring::PanoramaReport& report);

// Projection of a panorama over a plane. Its centre is a multiple of kCentreStep (mirror_scene.h).
Projection ProjectionOf(const authoring::PinholeView& panorama);

// Makes the record that of the document's panorama; null: how it was made is not known.
void PutFootage(authoring::Document& document,
                std::shared_ptr<const authoring::FootageRecord> record);

}  // namespace arthro::app
