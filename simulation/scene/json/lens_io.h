// Lenses from and to files [method.md, File formats]:
//   {schema, model, width, height, focal_px, cx, cy, aspect, k, fov_deg, circle:{cx, cy, r},
//   rms_px, camera:{fringe, rim_blur, sharpening, grain}}
// Angles in degrees, all else in px. `schema`, `aspect`, `k`, `fov_deg`, `circle`, `rms_px`
// and `camera` may be left out of a file that a person writes; unknown keys are refused, but for
// those that begin with "x-". The schema for other tools is resources/schemas/lens-1.schema.json;
// `arthroscene check --lens-schema` prints it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "simulation/scene/lens.h"

namespace arthro {

class JsonObjectReader;

std::string_view ToString(LensModel model);  // word of the file: "equisolid", "kannala_brandt", …

// Throws Error(kBadData) that names every key at fault and what it may be, Error(kFile) where there
// is no such file. A field of view that the file leaves out is worked out from the circle.
Lens ReadLens(const std::filesystem::path& file);
Lens LensFromJson(const std::string& text, const std::filesystem::path& file);

// Reads the optional object `camera` of a lens or of its preset; a key that is left out keeps its
// value.
void ReadCamera(JsonObjectReader& owner, LensCamera& camera);

std::string LensSchemaText();

std::string JsonFromLens(const Lens& lens);
// Written whole or not at all; "-" is standard output.
void WriteLens(const std::filesystem::path& file, const Lens& lens);

}  // namespace arthro
