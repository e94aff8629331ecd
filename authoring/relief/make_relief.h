// Footage to measured relief: camera poses from tracks, the portal from the shafts, and the radius
// of the surface over directions from the portal. Plain types only.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "authoring/relief/known_length.h"
#include "authoring/relief/relief_options.h"
#include "authoring/relief/relief_report.h"
#include "simulation/core/progress.h"
#include "simulation/scene/image.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

struct ReliefRequest {
  std::filesystem::path footage;
  std::optional<Lens> lens;  // nothing: the focal length is found from the clip
  ReliefOptions options;
  std::vector<KnownLength> lengths;
  std::vector<KnownInstrument> instruments;
};

struct ReliefResult {
  DepthMap relief;      // m, NaN where nothing was measured; empty where no surface was found
  DepthMap confidence;  // 0 to 1, probability of an error below 1 mm
  ReliefReport report;
};

// A clip that does not determine depth gives a verdict and what there is. Throws Error for footage
// or a lens that cannot be used, a known length that was not measured or that contradicts another,
// and Error(kCancelled).
ReliefResult MakeRelief(const ReliefRequest& request, const Progress& progress);

}  // namespace arthro::authoring
