// Report of a model of the library as JSON: arthroscene.model/1. m, m³.
#pragma once

#include <string>

#include "authoring/models/library_model.h"
#include "authoring/models/model_library.h"

namespace arthro::authoring {

// Sizes with their published ranges and sources, volume, area per part, regions, material, and the
// cuts of a tear. `removed`: volume of the slot of each cut together, m³.
std::string ModelReportText(const LibraryModel& model, const ModelOptions& options, KneeSide side,
                            const std::vector<Cut>& cuts, double removed);

}  // namespace arthro::authoring
