// Projection that a panorama's report states, and no more: reports of other programs that have
// these entries are accepted too. Whole reports: report_io.h.
#pragma once

#include <filesystem>

#include "simulation/scene/projection.h"

namespace arthro::authoring {

struct ReportedView {
  Projection projection;
  double width = 0, height = 0;  // size of the panorama, px
};

// Reads the entry `panorama` of a report. The projection has no roll. Throws Error(kBadData) with
// the number that is missing, Error(kFile).
ReportedView ReadReportedView(const std::filesystem::path& report);

}  // namespace arthro::authoring
