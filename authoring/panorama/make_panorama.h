// Footage to panorama [paper, 3.1]: reads, evens out the light, finds the relative positions of the
// frames, composes. Keeps the product of each stage, so that after a change of an option or an
// exclusion of a frame only the dependent stages run again.
//
// The interface has plain types only; OpenCV stays inside.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "authoring/footage/footage.h"
#include "authoring/footage/pixel_box.h"
#include "authoring/panorama/clip/panorama_options.h"
#include "authoring/panorama/clip/panorama_report.h"
#include "authoring/panorama/ties/frame_tie.h"
#include "simulation/core/progress.h"
#include "simulation/scene/image.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

struct PanoramaRequest {
  std::filesystem::path footage;
  // Further clips of the same joint through the same lens. Their frames follow those of `footage`
  // and are counted on.
  std::vector<std::filesystem::path> joined;
  std::optional<Lens>
      lens;  // none: the pictures are unchanged, as from a pinhole with a guessed focal length
  PanoramaOptions options;
  std::set<int> excluded;  // frames that a person excludes, by index in the footage
  // Rectangles of the raw pictures that show no tissue, such as text: neither matched nor drawn.
  std::vector<PixelBox> masked;
  // Places of frames that did not register, by hand. The places of all other frames stay.
  std::vector<FrameTie> ties;
  // Report of an earlier run: its frames keep their places, and no pairs are matched; null: none.
  std::shared_ptr<const PanoramaReport> known;
};

Clips ClipsOf(const PanoramaRequest& request);

struct PanoramaResult {
  RgbaPicture picture;              // component 0
  std::vector<RgbaPicture> pieces;  // the report's pieces, in their order; empty: too few frames
  PanoramaReport report;
};

// Callbacks of a window while the job runs. Called from the job's thread; any may be empty.
struct PanoramaObserver {
  // Called for each frame read, with a small picture (empty when there is none). Called again
  // without a picture when the frame's position is known, and at the end.
  std::function<void(const FrameReport&, const ColourImage& small)> frame;
  // Called with the growing panorama, small.
  std::function<void(const RgbaPicture&)> mosaic;
};

// Stage of a frame's picture: as recorded, without distortion, with evened-out light.
enum class FrameStage { kRaw, kRectified, kEvenLight };

class PanoramaSession {
 public:
  PanoramaSession();
  PanoramaSession(PanoramaSession&&) noexcept;
  PanoramaSession& operator=(PanoramaSession&&) noexcept;
  ~PanoramaSession();

  // Runs the stages that the request changes since the last run. Throws Error for footage that
  // gives no panorama and for a wrong lens or option, and Error(kCancelled) within half a second of
  // a stop. Completed stages are kept.
  PanoramaResult Run(const PanoramaRequest& request, const PanoramaObserver& observer,
                     const Progress& progress);

  // First stage that Run would repeat for this request: "read", "register", "tie", "compose"; ""
  // for none.
  std::string NextStage(const PanoramaRequest& request) const;

  // Picture of a frame of the last request after the stage "prepare"; kEvenLight of usable frames
  // only. Returns nothing when there is no such picture. Reads the footage again for the other two.
  std::optional<ColourImage> PictureOf(int index, FrameStage stage) const;

 private:
  struct Products;
  PanoramaResult RunOnce(const PanoramaRequest& request, const PanoramaObserver& observer,
                         const Progress& progress, int corrections_left);

  std::unique_ptr<Products> products_;
};

// Runs all stages in one call.
PanoramaResult MakePanorama(const PanoramaRequest& request, const Progress& progress);

}  // namespace arthro::authoring
