// Report of an alignment as JSON text, arthroscene.align/1: pose, standard errors, residuals and
// warnings of the pairs; side, steps and distances of the surface. m; angles in degrees in the
// file.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "authoring/alignment/landmark_alignment.h"
#include "authoring/alignment/surface_alignment.h"

namespace arthro::authoring {

std::string AlignReportText(const std::string& tissue, std::span<const LandmarkPair> pairs,
                            const std::optional<LandmarkAlignment>& landmarks,
                            const std::optional<SurfaceAlignment>& surface);

// Its JSON Schema; the copy for other tools is resources/schemas/align-1.schema.json.
std::string AlignReportSchemaText();

}  // namespace arthro::authoring
