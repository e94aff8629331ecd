#include "app/steps/depth/depth_board.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/state/edits.h"
#include "app/state/footage/measured_backdrop.h"
#include "app/steps/depth/depth_overlay.h"
#include "app/steps/depth/depth_step.h"
#include "authoring/adjustment/scale_backdrop.h"
#include "authoring/relief/editing/relief_scale.h"
#include "simulation/core/error.h"
#include "simulation/core/same_options.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

using authoring::Document;
using authoring::ReliefReading;

MeasuredBackdrop BackdropOf(const Document& document) {
  return {document.panorama,
          document.depth,
          document.depth_sigma,
          document.depth_origin,
          document.scene.backdrop.projection,
          document.scene.backdrop.radius};
}

authoring::ScalePart ScaleOf(const authoring::ReliefView& view, const LengthPick& length,
                             const char* source) {
  authoring::ScalePart part =
      authoring::ScaleFromLength(view, {length.metres, *length.points.from, *length.points.to});
  part.source = source;
  return part;
}

}  // namespace

void PointPair::Add(const glm::dvec2& point) {
  if (!from || to) {
    from = point;
    to.reset();
  } else {
    to = point;
  }
}

bool ShowsDepthBoard(const EditorState& state) {
  return state.step == Step::kDepth && state.steps.depth->board.is_shown &&
         state.document().panorama && !state.practice && !state.practice_only;
}

authoring::ReliefView ReliefViewOf(const Document& document) {
  return {OrEmpty(document.depth), OrEmpty(document.depth_sigma), OrEmpty(document.depth_origin),
          document.scene.backdrop.projection, document.scene.backdrop.radius};
}

bool HasMeasuredDepth(const Document& document) { return document.depth && document.depth_origin; }

std::string WordsOfOrigin(ReliefOrigin origin) {
  switch (origin) {
    case ReliefOrigin::kMeasured:
      return "measured";
    case ReliefOrigin::kBrightness:
      return "estimated from brightness";
    case ReliefOrigin::kInterpolated:
      return "interpolated";
    case ReliefOrigin::kNone:
      break;
  }
  return "not known";
}

double ShareWithinOneMm(double sigma) {
  return std::isfinite(sigma) && sigma > 0
             ? std::erf(MetresFromMm(1) / (sigma * std::numbers::sqrt2))
             : std::numeric_limits<double>::quiet_NaN();
}

std::string WordsOfReading(const Document& document, const ReliefReading& reading) {
  if (!document.depth) return "There is no depth map yet.";
  if (!std::isfinite(reading.range)) return "No depth is known here.";
  std::string words = fmt::format("{:.1f}", MmFromMetres(reading.range));
  // The noise of a depth from brightness says nothing about its error.
  if (std::isfinite(reading.sigma) && document.is_depth_imported)
    words += fmt::format(" ± {:.1f}", MmFromMetres(reading.sigma));
  words += " mm from the portal";
  if (document.depth_origin) return words + ", " + WordsOfOrigin(reading.origin);
  return words + (document.is_depth_imported ? "" : ", estimated, not measured");
}

std::string WordsOfDistance(const Document& document, const PointPair& points) {
  if (!points.is_complete()) return "";
  const authoring::ReliefView view = ReliefViewOf(document);
  const ReliefReading a = authoring::ReadRelief(view, *points.from),
                      b = authoring::ReadRelief(view, *points.to);
  const double distance = glm::distance(a.point, b.point);
  return std::isfinite(distance) ? fmt::format("{:.1f} mm", MmFromMetres(distance))
                                 : "not known, since a point has no depth";
}

void ClickDepth(EditorState& state, const glm::dvec2& pixel) {
  DepthBoard& board = state.steps.depth->board;
  switch (board.tool) {
    case MapTool::kRead:
      board.read = pixel;
      break;
    case MapTool::kLength:
      board.length().points.Add(pixel);
      board.length().is_given = false;
      break;
    case MapTool::kProfile:
      board.profile.Add(pixel);
      break;
    case MapTool::kBrush:
      PaintDepth(state, pixel);
      break;
  }
}

bool CanSetScale(const EditorState& state) {
  const Document& document = state.document();
  return document.depth && document.is_depth_imported &&
         state.steps.depth->board.length().points.is_complete();
}

void SetScale(EditorState& state) {
  DepthBoard& board = state.steps.depth->board;
  const Document& document = state.document();
  if (!CanSetScale(state)) return;
  const authoring::ReliefView view = ReliefViewOf(document);
  LengthPick& chosen = board.length();
  std::vector<authoring::ScalePart> parts;
  if (&chosen == &board.tissue || board.tissue.is_given)
    parts.push_back(ScaleOf(view, board.tissue, "length"));
  if (&chosen == &board.instrument || board.instrument.is_given)
    parts.push_back(ScaleOf(view, board.instrument, "instrument"));
  const double factor = authoring::JoinScales(parts).factor;

  MeasuredBackdrop backdrop = BackdropOf(document);
  const double before = backdrop.radius;
  backdrop.radius *= factor;
  backdrop.depth = Share(authoring::ScaledMap(*document.depth, factor));
  if (document.depth_sigma)
    backdrop.sigma = Share(authoring::ScaledMap(*document.depth_sigma, factor));
  Edit(state, fmt::format("Set the scale by {:g} mm", MmFromMetres(chosen.metres)), "",
       [&](Document& next) {
         const authoring::SharedStrokes strokes = next.depth_strokes;
         const authoring::UnmendedDepth unmended = next.unmended;
         PutMeasuredDepth(next, backdrop);
         next.depth_strokes = strokes;
         next.unmended = unmended;
         authoring::ScaleStrokes(next, factor);
       });
  chosen.is_given = true;
  state.message = fmt::format(
      "The scale changed: the radius of the backdrop was {:.1f} mm and is {:.1f} mm "
      "(factor {:.3f}).",
      MmFromMetres(before), MmFromMetres(backdrop.radius), factor);
}

bool HasLengths(const EditorState& state) {
  const auto is_there = [](const LengthPick& length) {
    return length.points.from || length.is_given;
  };
  const DepthBoard& board = state.steps.depth->board;
  return is_there(board.tissue) || is_there(board.instrument);
}

void ForgetLengths(EditorState& state) {
  DepthBoard& board = state.steps.depth->board;
  for (LengthPick* length : {&board.tissue, &board.instrument}) {
    length->points = {};
    length->is_given = false;
  }
}

namespace {

// Draws the part of the map that the stroke under way changes: of what was drawn before, only the
// pixels that its last piece reaches.
void KeepPatchFresh(EditorState& state) {
  DepthBoard& board = state.steps.depth->board;
  DepthBoard::Patch& patch = board.patch;
  DepthBrush& brush = board.brush;
  if (patch.version == brush.version) return;
  if (!brush.growing || brush.changed.is_empty()) {
    patch = {};
    patch.version = brush.version;
    return;
  }
  const CoarseMap coarse{brush.growing->depth().relief, *brush.coarse_picture, brush.stride};
  // A slope is drawn from pixels beside it.
  const auto with_rim = [&](const PixelBounds& box) {
    return Grown(box, kShapeReach + 1, coarse.depth.width, coarse.depth.height);
  };
  const bool is_first =
      !patch.picture || patch.layer != board.layer || patch.stroke.lock() != brush.growing;
  const PixelBounds box = with_rim(brush.changed), old = patch.box;
  std::vector<PixelBounds> parts{box};
  if (!is_first)
    parts = {brush.fresh.is_empty() ? PixelBounds() : with_rim(brush.fresh),
             {box.left, box.top, old.left, box.bottom},
             {old.right, box.top, box.right, box.bottom},
             {old.left, box.top, old.right, old.top},
             {old.left, old.bottom, old.right, box.bottom}};
  ColourImage picture(box.width(), box.height());
  const auto put = [&](const ColourImage& part, const PixelBounds& place) {
    for (int y = 0; y < part.height; ++y)
      std::copy_n(part.at(0, y), 3 * static_cast<std::size_t>(part.width),
                  picture.at(place.left - box.left, place.top - box.top + y));
  };
  if (!is_first) put(*patch.picture, old);
  patch.drawn = 0;
  for (const PixelBounds& part : parts) {
    if (part.is_empty()) continue;
    put(DrawCoarse(state.document(), board.layer, coarse, part), part);
    patch.drawn += part.width() * part.height();
  }
  const glm::dvec2 size =
      glm::dvec2(state.document().panorama->width, state.document().panorama->height) /
      static_cast<double>(coarse.stride);
  patch.picture = Share(std::move(picture));
  patch.low = glm::dvec2(box.left, box.top) / size;
  patch.high = glm::dvec2(box.right, box.bottom) / size;
  patch.box = box;
  patch.layer = board.layer;
  patch.stroke = brush.growing;
  patch.version = brush.version;
  brush.fresh = {};
}

void KeepComparedFresh(EditorState& state) {
  const Document& document = state.document();
  DepthBoard::Compared& compared = state.steps.depth->board.compared;
  if (compared.relief && compared.panorama == document.panorama &&
      compared.depth == document.depth && SameOptions(compared.options, document.depth_options))
    return;
  const authoring::DepthPreview& pyramid = PyramidOf(state);
  compared.panorama = document.panorama;
  compared.depth = document.depth;
  compared.options = document.depth_options;
  compared.grey = Share(GreyPicture(pyramid.Picture(), document.depth_options));
  compared.filtered = Share(FilteredPicture(pyramid, document));
  compared.relief = Share(DrawLayer(document, MapLayer::kShape).picture);
}

}  // namespace

void KeepDepthBoardFresh(EditorState& state) {
  DepthBoard& board = state.steps.depth->board;
  const Document& document = state.document();
  DepthBoard::Drawn& drawn = board.drawn;
  if (drawn.panorama != document.panorama) {
    board.read.reset();
    board.profile = {};
    CancelStroke(state);
    board.zoom = {};
    ForgetLengths(state);
  }
  if (!ShowsDepthBoard(state)) {
    if (!board.is_shown) drawn.picture.reset();
    drawn.panorama = document.panorama;
    return;
  }
  const double radius = document.scene.backdrop.radius;
  const bool is_same = drawn.picture && drawn.panorama == document.panorama &&
                       drawn.depth == document.depth && drawn.sigma == document.depth_sigma &&
                       drawn.origin == document.depth_origin && drawn.layer == board.layer &&
                       drawn.radius == radius && drawn.strokes == document.depth_strokes &&
                       SameOptions(drawn.options, document.depth_options);
  if (!is_same) {
    drawn.panorama = document.panorama;
    drawn.depth = document.depth;
    drawn.sigma = document.depth_sigma;
    drawn.origin = document.depth_origin;
    drawn.layer = board.layer;
    drawn.radius = radius;
    drawn.strokes = document.depth_strokes;
    drawn.options = document.depth_options;
    DrawnLayer layer = DrawLayer(document, board.layer);
    drawn.picture = std::make_shared<const ColourImage>(std::move(layer.picture));
    drawn.legend = std::move(layer.legend);
  }
  KeepPatchFresh(state);
  if (board.compares) KeepComparedFresh(state);
}

}  // namespace arthro::app
