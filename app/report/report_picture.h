// Pictures of an attempt in its report: what the scope showed at the end of each step and at each
// fault. Their choice is made here; they are drawn by draw_pictures.h.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "app/records/attempts/attempt_record.h"
#include "simulation/training/observe/attempt_frame.h"

namespace arthro::app {

// Steps of the exercise by their ids: the number of each, from 1, and what was asked for. Without
// an entry a step is shown by its id.
struct StepName {
  std::size_t number = 0;
  std::string title;
};
using StepNames = std::map<std::string, StepName>;
// "2"
std::string StepNumber(const StepNames& names, const std::string& id);
// "2. Touch the spine"
std::string StepLine(const StepNames& names, const std::string& id);

// A moment that the report shows.
struct ReportMoment {
  double t = 0;  // s after the begin of the attempt
  std::string words;
  bool is_fault = false;
};

struct ReportPicture {
  ReportMoment moment;
  std::string jpeg;
};

// Ends of steps, and faults: a zone that was entered, a cut outside of the regions, a body that was
// dropped, and the largest force where it is not within its limit. A fault that a criterion allows
// is left out. In the order of time; of many faults the first kMostFaultPictures.
inline constexpr std::size_t kMostFaultPictures = 6;
std::vector<ReportMoment> MomentsOf(const AttemptRecord& attempt,
                                    std::span<const simulation::AttemptFrame> frames,
                                    const StepNames& names = {});

// The pictures as a part of the page, three in a row. `has_tissue`: they show tissue as it was, not
// at rest.
std::string PicturesHtml(std::span<const ReportPicture> pictures, bool has_tissue);

}  // namespace arthro::app
