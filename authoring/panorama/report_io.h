// A panorama and its report as files. The report is JSON [method.md, File formats], by
// resources/schemas/panorama-1.schema.json; with `panorama` in it a scene knows its projection.
#pragma once

#include <filesystem>
#include <string>

#include "authoring/panorama/panorama_report.h"

namespace arthro::authoring {

std::string JsonFromReport(const PanoramaReport& report);

// Written whole or not at all; "-" is standard output.
void WriteReport(const std::filesystem::path& file, const PanoramaReport& report);

// PNG keeps what was imaged as alpha; JPEG has none, and shows the rest black. "-" is PNG on
// standard output. Throws Error(kBadArgument) for another ending, Error(kFile).
void WritePanorama(const std::filesystem::path& file, const RgbaPicture& picture);

// Throws what WritePanorama would for this name, without writing: an hour of work should not end
// on a wrong folder.
void CheckPanoramaName(const std::filesystem::path& file);

}  // namespace arthro::authoring
