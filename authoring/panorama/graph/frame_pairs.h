// Estimates pairs of a clip's working frames by features or direct alignment, whichever the pair
// needs. The data of each frame is computed once, in the constructor.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "authoring/panorama/frames/working_frame.h"
#include "authoring/panorama/graph/links/pair_book.h"
#include "authoring/panorama/graph/register.h"
#include "authoring/panorama/pairs/direct_pyramid.h"
#include "authoring/panorama/pairs/frame_features.h"

namespace arthro::authoring {

class FramePairs {
 public:
  FramePairs(const std::vector<WorkingFrame>& frames, const RegisterOptions& options,
             const Progress& progress);

  // Reason why frame i cannot be compared with any other; empty when it can.
  const std::vector<std::string>& unusable() const { return unusable_; }

  // Safe to call from several threads.
  std::optional<PairEstimate> Make(const PairRequest& request, std::string* why_not) const;

 private:
  std::optional<PairEstimate> ByFeatures(const PairRequest& request, std::string* why_not) const;
  std::optional<PairEstimate> Direct(const PairRequest& request, std::string* why_not) const;

  const RegisterOptions& options_;
  std::vector<std::optional<DirectPyramid>> pyramids_;
  std::vector<std::optional<FrameFeatures>> features_;  // none when only direct alignment is used
  std::vector<std::string> unusable_;
};

}  // namespace arthro::authoring
