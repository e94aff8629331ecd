// Pairs a depth map with the panorama, options and strokes that it was made from. Depth is made
// from them by work beside the window, so for a while a document may hold the depth of other
// options: it is then stale. Also hands out again what was made before, so that undo does not
// compute twice.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "authoring/depth/depth_preview.h"
#include "authoring/project/estimated_depth.h"

namespace arthro::app {

class DepthCache {
 public:
  // Records that the depth map of `document` was made from its panorama and options.
  void Note(const authoring::Document& document);
  // Nor can there be any better one, for the reason given.
  void Refuse(const authoring::Document& document, const std::string& reason);
  std::string ProblemOf(const authoring::Document& document) const;  // "" where there is none
  bool IsStale(const authoring::Document& document) const;
  // Made before and still in memory; its depth is null if not.
  authoring::EstimatedDepth Find(const authoring::Document& document) const;

  // Shown by the pictures while the document's depth is stale; null otherwise.
  std::shared_ptr<const DepthMap> preview;
  std::shared_ptr<const ColourImage> preview_panorama;
  authoring::DepthOptions preview_options;
  authoring::SharedStrokes preview_strokes;
  // Made in a job, for the panorama that it was made of; shared with the job that uses it.
  std::shared_ptr<const authoring::DepthPreview> pyramid;
  std::weak_ptr<const ColourImage> pyramid_of;

 private:
  struct Made {
    std::weak_ptr<const ColourImage> panorama;
    authoring::DepthOptions options;
    authoring::SharedStrokes strokes;
    std::weak_ptr<const DepthMap> depth, sigma;
    bool has_depth = false, has_sigma = false;
    std::string problem = {};
  };
  static bool IsOf(const Made& made, const authoring::Document& document);

  std::vector<Made> made_;
};

}  // namespace arthro::app
