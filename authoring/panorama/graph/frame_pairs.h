// Makes pair estimates of a clip's working frames: features and direct alignment, whichever the
// pair needs. What a frame is compared by is built once, when the maker is.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "authoring/panorama/frames/working_frame.h"
#include "authoring/panorama/graph/pair_book.h"
#include "authoring/panorama/graph/register.h"
#include "authoring/panorama/pairs/direct_pyramid.h"
#include "authoring/panorama/pairs/frame_features.h"

namespace arthro::authoring {

class FramePairs {
 public:
  FramePairs(const std::vector<WorkingFrame>& frames, const RegisterOptions& options,
             const Progress& progress);

  // Why frame i cannot be compared with any other; empty: it can.
  const std::vector<std::string>& unusable() const { return unusable_; }

  // Safe to call from several threads.
  std::optional<PairEstimate> Make(const PairRequest& request, std::string* why_not) const;

 private:
  std::optional<PairEstimate> ByFeatures(const PairRequest& request, std::string* why_not) const;
  std::optional<PairEstimate> Direct(const PairRequest& request, std::string* why_not) const;

  const RegisterOptions& options_;
  std::vector<std::optional<DirectPyramid>> pyramids_;
  std::vector<std::optional<FrameFeatures>> features_;  // none when only direct is asked for
  std::vector<std::string> unusable_;
};

}  // namespace arthro::authoring
