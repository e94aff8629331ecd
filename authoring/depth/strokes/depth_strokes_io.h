// Strokes as JSON text: an object with "schema" and "strokes", each stroke with the fields of its
// Visit and "points" as pairs of numbers, [[u, v], …], in shares of the panorama's width.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "authoring/depth/strokes/depth_stroke.h"

namespace arthro::authoring {

inline constexpr const char* kStrokesSchema = "arthroscene.depth-strokes/1";

std::string StrokesText(const DepthStrokes& strokes);

// Throws Error(kBadData) that names `file`, the field and what it must be.
DepthStrokes StrokesFromText(std::string_view text, const std::filesystem::path& file);

}  // namespace arthro::authoring
