// Footage to measured relief: camera poses from tracks, the portal from the shafts, and the radius
// of the surface over directions from the portal. Plain types only.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include <glm/vec3.hpp>

#include "authoring/panorama/clip/panorama_report.h"
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
  std::set<int> excluded;      // frames that a person excludes, by index in the footage
  bool draws_panorama = true;  // false: no picture, and no expected errors
};

// Maps over the directions of report.projection, of one size. All are empty where no surface was
// found.
struct ReliefResult {
  DepthMap relief;      // m, NaN where no frame sees the tissue
  DepthMap sigma;       // m, standard error of the relief; NaN where the relief is
  DepthMap confidence;  // 0 to 1, probability of an error below 1 mm; 0 where it was not measured
  OriginMap origin;
  // Panorama over the relief, of `picture_scale` times the maps' size: texture of the tissue as
  // seen from the portal. Alpha is 0 where no frame sees it.
  RgbaPicture picture;
  int picture_scale = 1;
  ReliefReport report;
};

// Poses and points while they are found, to be shown. Frame and unit are those of the first camera
// until the portal is known; then metres in the portal frame.
struct ReliefSoFar {
  struct Camera {
    glm::dvec3 centre{0.0}, view{0.0};
  };
  std::vector<Camera> cameras;
  std::vector<glm::dvec3> points;  // a sample
  bool is_in_portal_frame = false;
};
// Called from the job's thread. May be empty.
using ReliefObserver = std::function<void(const ReliefSoFar&)>;

// Directions of the pixels of a map that is enlarged by a whole factor.
Projection EnlargedProjection(const Projection& projection, int factor);

// A clip that does not determine depth gives a verdict and what there is. Throws Error for footage
// or a lens that cannot be used, a known length that was not measured or that contradicts another,
// and Error(kCancelled) within half a second of a stop.
ReliefResult MakeRelief(const ReliefRequest& request, const Progress& progress,
                        const ReliefObserver& observer = {});

}  // namespace arthro::authoring
