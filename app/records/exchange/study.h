// Records for a study, under other pseudonyms than those of the department: codes, ids, cohorts and
// raters are replaced, times are counted from the first attempt of each trainee, and free text,
// stations and files are left out. Hand and experience stay.
#pragma once

#include <cstdint>

#include "app/records/attempts/attempt_record.h"

namespace arthro::app {

// The same seed gives the same pseudonyms. Whoever knows the seed and all codes can undo them.
RecordsBundle ForStudy(RecordsBundle bundle, std::uint64_t seed);

}  // namespace arthro::app
