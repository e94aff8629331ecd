#include "authoring/project/history.h"

#include <algorithm>
#include <cstdlib>
#include <set>

namespace arthro::authoring {
namespace {

// Adds the big parts of `document` that are not in `seen` yet.
std::size_t BytesOfNewParts(const Document& document, std::set<const void*>& seen) {
  std::size_t bytes = 0;
  const auto is_new = [&](const void* part) { return part && seen.insert(part).second; };
  if (is_new(document.panorama.get())) bytes += document.panorama->rgb.capacity();
  for (const auto& map :
       {document.depth, document.depth_sigma, document.unmended.depth, document.unmended.sigma})
    if (is_new(map.get())) bytes += map->relief.capacity() * sizeof(float);
  for (const auto& map : {document.depth_origin, document.unmended.origin})
    if (is_new(map.get())) bytes += map->origin.capacity();
  if (is_new(document.footage.get())) bytes += document.footage->report.capacity();
  for (const auto& surface : document.surfaces)
    if (is_new(surface.get()))
      bytes += surface->vertices.capacity() * sizeof(surface->vertices[0]) +
               surface->triangles.capacity() * sizeof(surface->triangles[0]);
  return bytes;
}

}  // namespace

History::History(Document document, std::size_t memory_limit) : memory_limit_(memory_limit) {
  steps_.push_back({std::move(document), "Open", ++last_id_});
}

void History::Push(Document next, const std::string& name, const std::string& merge_key) {
  const bool merges = !merge_key.empty() && merge_key == merge_key_ && CanUndo();
  Step step{std::move(next), name, ++last_id_};
  steps_.resize(position_ + 1);
  if (merges) {
    steps_.back() = std::move(step);
  } else {
    steps_.push_back(std::move(step));
    ++position_;
  }
  merge_key_ = merge_key;
  DropOldest();
}

void History::Amend(Document document) {
  steps_[position_].document = std::move(document);
  steps_[position_].id = ++last_id_;
  DropOldest();
}

void History::Undo() { GoTo(Position() - 1); }

void History::Redo() { GoTo(Position() + 1); }

std::vector<std::string> History::StepNames() const {
  std::vector<std::string> names;
  for (const Step& step : steps_) names.push_back(step.name);
  return names;
}

void History::GoTo(int position) {
  position_ =
      static_cast<std::size_t>(std::clamp(position, 0, static_cast<int>(steps_.size()) - 1));
  EndMerge();
}

void History::MarkSaved() {
  saved_id_ = steps_[position_].id;
  EndMerge();  // a drag that goes on after saving is a change of its own
}

void History::MarkSaved(Document saved) {
  steps_[position_].document = std::move(saved);
  MarkSaved();
}

int History::StepsFromSaved() const {
  for (std::size_t i = 0; i < steps_.size(); ++i)
    if (steps_[i].id == saved_id_)
      return std::abs(static_cast<int>(i) - static_cast<int>(position_));
  return static_cast<int>(position_);
}

std::set<std::filesystem::path> History::FilesOnlyOnDisk() const {
  std::set<std::filesystem::path> files;
  for (const Step& step : steps_)
    for (const auto& [name, asset] : step.document.files)
      if (asset.part.expired()) files.insert(asset.file.lexically_normal());
  return files;
}

std::size_t History::MemoryUsed() const {
  std::set<const void*> seen;
  std::size_t bytes = 0;
  for (const Step& step : steps_) bytes += BytesOfNewParts(step.document, seen);
  return bytes;
}

// From the newest back: keeps as many steps as fit, and always the one before the current, so that
// the last edit can be undone.
void History::DropOldest() {
  constexpr std::size_t kMostSteps = 1000;
  std::set<const void*> seen;
  std::size_t bytes = 0, kept = 0;
  for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
    bytes += BytesOfNewParts(step->document, seen);
    if (kept >= 2 && (bytes > memory_limit_ || kept >= kMostSteps)) break;
    ++kept;
  }
  const std::size_t dropped = steps_.size() - kept;
  steps_.erase(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(dropped));
  position_ -= dropped;
}

}  // namespace arthro::authoring
