// Footage to panorama [paper, 3.1]: reads, evens out the light, finds how the frames lie to each
// other, composes. Each stage's product is kept, so that a window can change an option or leave a
// frame out and only what depends on it is done again.
//
// Plain types only: what is inside is OpenCV's, who calls need not be.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "authoring/panorama/panorama_options.h"
#include "authoring/panorama/panorama_report.h"
#include "simulation/core/progress.h"
#include "simulation/scene/image.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

struct PanoramaRequest {
  std::filesystem::path footage;
  std::optional<Lens> lens;  // none: the pictures are taken as they are, through a guessed pinhole
  PanoramaOptions options;
  std::set<int> excluded;  // frames that a person leaves out, by index in the footage
};

struct PanoramaResult {
  RgbaPicture picture;              // of component 0
  std::vector<RgbaPicture> pieces;  // of the report's pieces, in their order; empty: too few frames
  PanoramaReport report;
};

// What a window shows while the job runs. Called from the job's thread; any may be empty.
struct PanoramaObserver {
  // As frames are read, with a small picture (empty where there is none); again, without one, when
  // it is known where they lie, and at the end.
  std::function<void(const FrameReport&, const ColourImage& small)> frame;
  // The panorama as it grows, small.
  std::function<void(const RgbaPicture&)> mosaic;
};

// A frame as the stages see it: as it was filmed, without the fisheye, with even light.
enum class FrameStage { kRaw, kRectified, kEvenLight };

class PanoramaSession {
 public:
  PanoramaSession();
  PanoramaSession(PanoramaSession&&) noexcept;
  PanoramaSession& operator=(PanoramaSession&&) noexcept;
  ~PanoramaSession();

  // Does what the request changes since the last one. Throws Error for footage that gives no
  // panorama, for a wrong lens or option, and Error(kCancelled) within half a second of being told;
  // stages that were over by then are kept.
  PanoramaResult Run(const PanoramaRequest& request, const PanoramaObserver& observer,
                     const Progress& progress);

  // The first stage that Run would do again for this request: "read", "register", "compose"; ""
  // when it would do none.
  std::string NextStage(const PanoramaRequest& request) const;

  // A frame of the last request that got as far as "prepare"; kEvenLight of usable frames only.
  // Nothing where there is no such picture. Reads the footage again for the other two.
  std::optional<ColourImage> PictureOf(int index, FrameStage stage) const;

 private:
  struct Products;
  PanoramaResult RunOnce(const PanoramaRequest& request, const PanoramaObserver& observer,
                         const Progress& progress, int corrections_left);

  std::unique_ptr<Products> products_;
};

// The same in one go.
PanoramaResult MakePanorama(const PanoramaRequest& request, const Progress& progress);

}  // namespace arthro::authoring
