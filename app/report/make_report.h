// Reports of attempts: from a result that was just made, and from the records.
#pragma once

#include <string>
#include <vector>

#include "app/records/people/reference_groups.h"
#include "app/records/store/records.h"
#include "app/report/attempt_report.h"
#include "simulation/scene/exercise/exercise.h"
#include "simulation/scene/files/loaded_scene.h"

namespace arthro::app {

// Sorts metrics of the records, which have no order, as they are measured.
void SortMetrics(std::vector<MetricRow>& rows);

// Report of a result with its frames. Attempt id, trainee, scene and mode are not known of it.
AttemptReport MakeReport(const Exercise& exercise, const simulation::AttemptResult& result,
                         std::vector<simulation::AttemptFrame> frames);

// Report of an attempt in the records, with the frames of its log. Where the log cannot be read the
// frames are missing, and `notice` is a sentence. Throws Error where there is no such attempt.
AttemptReport ReportFromRecords(Records& records, const std::string& attempt, std::string& notice);

// Sets the metrics of the expert's attempt where there is one (records/keeping/expert_attempt.h).
// `exercise`: of the scene. Throws Error where it cannot be read.
void SetExpert(AttemptReport& report, const LoadedScene& loaded, const Exercise& exercise,
               Records* records);

// Standing of an attempt's metrics in a group; z-values of an attempt that came to its end.
std::vector<GroupStanding> StandingsIn(Records& records, const ReferenceGroup& group,
                                       const AttemptRecord& attempt);

// Sets the standing of each metric in a reference group of the report's exercise. Throws Error with
// the groups that there are, and for a group of another rig.
void SetGroup(AttemptReport& report, Records& records, const std::string& group);

}  // namespace arthro::app
