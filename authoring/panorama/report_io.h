// Panorama and report as files. The report is JSON [method.md, File formats], by
// resources/schemas/panorama-1.schema.json; its entry `panorama` gives a scene its projection.
#pragma once

#include <filesystem>
#include <string>

#include "authoring/panorama/clip/panorama_report.h"

namespace arthro::authoring {

std::string JsonFromReport(const PanoramaReport& report);

// Throws Error(kBadData) for what is no such report. Costs come in the order of their names.
PanoramaReport ReportFromJson(const std::string& text, const std::filesystem::path& file = {});

// Projection that a report gives a scene, without roll, and the size of its panorama, px.
struct ReportedView {
  Projection projection;
  int width = 0, height = 0;
};
// Reads the entry `panorama` alone, so that reports of other programs which have it are accepted.
// Throws Error(kBadData) with the key that is missing or of the wrong kind.
ReportedView ViewFromReport(const std::string& text, const std::filesystem::path& file = {});

// Writes the whole file or none; "-" is standard output.
void WriteReport(const std::filesystem::path& file, const PanoramaReport& report);

// Writes PNG with the imaged area as alpha, or JPEG, which has no alpha and is black elsewhere. "-"
// is PNG on standard output. Throws Error(kBadArgument) for another extension, Error(kFile).
void WritePanorama(const std::filesystem::path& file, const RgbaPicture& picture);

// Throws the errors of WritePanorama for this name, without writing: a wrong folder must not end an
// hour of work.
void CheckPanoramaName(const std::filesystem::path& file);

}  // namespace arthro::authoring
