#include "authoring/panorama/compose_pieces.h"

#include <set>
#include <utility>

#include "authoring/panorama/chosen_pictures.h"
#include "authoring/panorama/compose/part_progress.h"

namespace arthro::authoring {
namespace {

std::set<int> PlacedIndices(const std::vector<FrameResult>& frames) {
  std::set<int> placed;
  for (const FrameResult& frame : frames)
    if (frame.is_placed && frame.component == 0) placed.insert(frame.index);
  return placed;
}

// Renumbers a component's frames as component 0.
std::vector<FrameResult> AsPanorama(std::vector<FrameResult> frames, int component) {
  for (FrameResult& frame : frames) {
    if (frame.component == component && component >= 0) {
      frame.component = 0;
      frame.is_placed = true;
    } else {
      frame.component = -1;
      frame.is_placed = false;
    }
  }
  return frames;
}

}  // namespace

std::map<int, int> FramesByComponent(const std::vector<FrameResult>& frames) {
  std::map<int, int> counts;
  for (const FrameResult& frame : frames)
    if (frame.component >= 0) ++counts[frame.component];
  return counts;
}

std::vector<ComposedPiece> ComposePieces(const Clips& footage, const cv::Rect& part,
                                         const Rectifier& rectifier,
                                         const std::vector<FrameResult>& frames, int least_piece,
                                         const ComposeOptions& options, const Progress& progress,
                                         const ComposeObserver& observer) {
  // Each piece has a part of the stage's progress, by its number of frames.
  const auto counts = FramesByComponent(frames);
  double all = 0, before = 0;
  for (const auto& [component, count] : counts)
    if (component == 0 || count >= least_piece) all += count;
  std::vector<ComposedPiece> pieces;
  for (const auto& [component, count] : counts) {
    if (component > 0 && count < least_piece) continue;
    const auto placed = AsPanorama(frames, component);
    const Progress of_piece = PartOf(progress, before, before + count / all);
    ComposedPiece piece;
    piece.component = component;
    ChosenPictures pictures(footage, PlacedIndices(placed));
    const auto source = [&](int& index, cv::Mat& rgb) {
      if (!pictures(index, rgb)) return false;
      rgb = rgb(part);
      return true;
    };
    piece.composed = Compose(source, rectifier, placed, options, &piece.report, of_piece,
                             component == 0 ? observer : ComposeObserver());
    pieces.push_back(std::move(piece));
    before += count / all;
  }
  return pieces;
}

}  // namespace arthro::authoring
