// Report and poses of a measured relief as JSON files [method.md, File formats], by
// resources/schemas/relief-1.schema.json and poses-1.schema.json.
#pragma once

#include <filesystem>
#include <string>

#include "authoring/relief/relief_report.h"

namespace arthro::authoring {

std::string JsonFromReliefReport(const ReliefReport& report);

// Frames with a pose: index, R (portal_from_camera, row-major) and C (m); and the pivot, which is
// the origin, where one was found.
std::string JsonFromPoses(const ReliefReport& report);

}  // namespace arthro::authoring
