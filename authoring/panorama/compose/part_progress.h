// Progress of one part of a job, as a range of the progress of the whole.
#pragma once

#include <string_view>

#include "simulation/core/progress.h"

namespace arthro::authoring {

// `whole` must outlive the part.
inline Progress PartOf(const Progress& whole, double from, double to) {
  Progress part;
  part.stop = whole.stop;
  if (whole.report)
    part.report = [&whole, from, to](std::string_view words, double done) {
      whole.report(words, from + (to - from) * done);
    };
  return part;
}

}  // namespace arthro::authoring
