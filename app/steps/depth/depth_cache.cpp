#include "app/steps/depth/depth_cache.h"

#include <algorithm>

#include "simulation/core/same_options.h"

namespace arthro::app {
namespace {

constexpr std::size_t kMostRecords = 64;  // records, not maps

}  // namespace

bool DepthCache::IsOf(const Made& made, const authoring::Document& document) {
  return made.panorama.lock() == document.panorama && made.strokes == document.depth_strokes &&
         SameOptions(made.options, document.depth_options);
}

void DepthCache::Note(const authoring::Document& document) {
  if (document.is_depth_imported) return;  // it was made from nothing that is known here
  std::erase_if(made_, [&](const Made& made) {
    const auto panorama = made.panorama.lock();
    return !panorama || IsOf(made, document);
  });
  made_.push_back({document.panorama, document.depth_options, document.depth_strokes,
                   document.depth, document.depth_sigma, document.depth != nullptr,
                   document.depth_sigma != nullptr});
  if (made_.size() > kMostRecords) made_.erase(made_.begin());
}

void DepthCache::Refuse(const authoring::Document& document, const std::string& reason) {
  if (document.is_depth_imported) return;
  Note(document);
  made_.back().problem = reason;
}

std::string DepthCache::ProblemOf(const authoring::Document& document) const {
  for (const Made& made : made_)
    if (IsOf(made, document)) return made.problem;
  return "";
}

bool DepthCache::IsStale(const authoring::Document& document) const {
  if (!document.panorama || document.is_depth_imported) return false;
  for (const Made& made : made_)
    if (IsOf(made, document) && made.has_depth == bool(document.depth) &&
        made.depth.lock() == document.depth)
      return false;
  return true;
}

authoring::EstimatedDepth DepthCache::Find(const authoring::Document& document) const {
  for (const Made& made : made_)
    if (IsOf(made, document)) {
      authoring::EstimatedDepth found{made.depth.lock(), made.sigma.lock()};
      if (made.has_sigma && !found.sigma) return {};
      return found;
    }
  return {};
}

}  // namespace arthro::app
