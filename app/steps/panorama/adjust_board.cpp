#include "app/steps/panorama/adjust_board.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/state/edits.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/panorama/board/board_picture.h"
#include "app/steps/panorama/panorama_step.h"
#include "authoring/adjustment/crop_backdrop.h"
#include "authoring/adjustment/mirror_scene.h"
#include "authoring/adjustment/orient_backdrop.h"
#include "authoring/adjustment/scale_backdrop.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

using authoring::Document;

authoring::PixelBox BoxBetween(const glm::dvec2& a, const glm::dvec2& b, const ColourImage& whole) {
  const auto pixel = [](double value, int size) {
    return std::clamp(static_cast<int>(std::lround(value)), 0, size - 1);
  };
  const int left = pixel(std::min(a.x, b.x), whole.width),
            right = pixel(std::max(a.x, b.x), whole.width),
            top = pixel(std::min(a.y, b.y), whole.height),
            bottom = pixel(std::max(a.y, b.y), whole.height);
  return {left, top, right - left + 1, bottom - top + 1};
}

// The depth map goes with the panorama, and is not estimated anew from it.
void Replace(EditorState& state, const std::string& name, Document next) {
  const bool is_stale = state.steps.depth->cache.IsStale(state.document());
  Edit(state, name, "", [&](Document& document) { document = std::move(next); });
  if (!is_stale) state.steps.depth->cache.Note(state.document());
}

}  // namespace

bool ShowsAdjustBoard(const EditorState& state) {
  return state.steps.panorama->adjust.tool != AdjustTool::kNone && state.step == Step::kPanorama &&
         !state.practice && !state.practice_only && !ShowsFootage(state) &&
         state.document().panorama;
}

bool ShowsPanoramaBoard(const EditorState& state) {
  return ShowsFootage(state) || ShowsAdjustBoard(state);
}

void SetAdjustTool(EditorState& state, AdjustTool tool) {
  AdjustBoard& board = state.steps.panorama->adjust;
  board.tool = board.tool == tool ? AdjustTool::kNone : tool;
  board.from.reset();
  board.to.reset();
}

void KeepAdjustPicture(EditorState& state) {
  AdjustBoard& board = state.steps.panorama->adjust;
  const auto& panorama = state.document().panorama;
  if (!panorama || board.drawn_from == panorama) return;
  board.shown = PictureFromColour(*panorama, kBoardEdge);
  board.drawn_from = panorama;
}

void ApplyAdjustment(EditorState& state) {
  AdjustBoard& board = state.steps.panorama->adjust;
  if (!board.from || !board.to) return;
  const AdjustTool tool = board.tool;
  const glm::dvec2 from = *board.from, to = *board.to;
  board.from.reset();
  board.to.reset();
  Document next = state.document();
  std::string name, result;
  switch (tool) {
    case AdjustTool::kNone:
      return;
    case AdjustTool::kCrop: {
      const authoring::PixelBox box = BoxBetween(from, to, OrEmpty(next.panorama));
      CropBackdrop(next, box);
      name = "Crop the panorama";
      result = fmt::format("The panorama is {} × {} px now.", box.width, box.height);
      break;
    }
    case AdjustTool::kLength: {
      const double factor =
          authoring::ScaleBackdrop(next, {MetresFromMm(board.millimetres), from, to});
      state.scope.depth *= factor;  // the scope stays at its place in the picture
      name = fmt::format("Set the scale by {:g} mm", board.millimetres);
      result =
          fmt::format("The scene changed by a factor of {:.3f}; its backdrop is {:.1f} mm away.",
                      factor, MmFromMetres(next.scene.backdrop.radius));
      break;
    }
    case AdjustTool::kUp:
    case AdjustTool::kMedial: {
      const authoring::PanoramaArrow arrow{from, to};
      const bool is_up = tool == AdjustTool::kUp;
      const double turn = OrientBackdrop(next, {is_up ? std::optional(arrow) : std::nullopt,
                                                is_up ? std::nullopt : std::optional(arrow)});
      name = is_up ? "Say what is up" : "Say what is medial";
      result = fmt::format("The scene was turned by {:.1f}°.", DegreesFromRadians(turn));
      break;
    }
  }
  Replace(state, name, std::move(next));
  state.message = result;
  SetAdjustTool(state, AdjustTool::kNone);
}

void MirrorForOtherKnee(EditorState& state) {
  Document next = state.document();
  MirrorScene(next, [&](const auto& file) { return state.scratch.NewFile(file); });
  Replace(state, "Mirror for the other knee", std::move(next));
  SetAdjustTool(state, AdjustTool::kNone);
}

}  // namespace arthro::app
