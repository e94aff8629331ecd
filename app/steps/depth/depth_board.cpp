#include "app/steps/depth/depth_board.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/state/measured_depth.h"
#include "app/steps/depth/depth_overlay.h"
#include "app/steps/depth/depth_step.h"
#include "authoring/relief/editing/relief_scale.h"
#include "authoring/relief/editing/wrong_cells.h"
#include "simulation/core/error.h"
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

// Origins of a depth that was made from brightness, which a document does not keep.
OriginMap EstimatedOrigins(const DepthMap& depth) {
  OriginMap origin(depth.width, depth.height);
  for (std::size_t i = 0; i < origin.origin.size(); ++i)
    if (!std::isnan(depth.relief[i])) origin.origin[i] = ReliefOrigin::kBrightness;
  return origin;
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
      BrushDepth(state, pixel);
      break;
  }
}

void BrushDepth(EditorState& state, const glm::dvec2& pixel) {
  if (!state.document().depth) return;
  std::vector<glm::dvec2>& stroke = state.steps.depth->board.stroke;
  if (stroke.empty() || glm::distance(stroke.back(), pixel) >= 1) stroke.push_back(pixel);
}

void EndBrush(EditorState& state) {
  DepthBoard& board = state.steps.depth->board;
  const std::vector<glm::dvec2> stroke = std::exchange(board.stroke, {});
  const Document& document = state.document();
  if (stroke.empty() || !document.depth) return;
  authoring::CellMarks marks(document.depth->width, document.depth->height);
  int marked = authoring::MarkAlong(stroke.front(), stroke.front(), board.brush_radius, marks);
  for (std::size_t i = 1; i < stroke.size(); ++i)
    marked += authoring::MarkAlong(stroke[i - 1], stroke[i], board.brush_radius, marks);
  if (marked == 0) return;
  const bool is_estimated = !document.depth_origin && !document.is_depth_imported;
  const OriginMap estimated = is_estimated ? EstimatedOrigins(*document.depth) : OriginMap();
  const authoring::ReliefView now = ReliefViewOf(document);
  authoring::ClosedRelief closed = authoring::CloseMarked(
      {now.relief, now.sigma, is_estimated ? estimated : now.origin, now.projection, now.radius},
      marks);
  MeasuredBackdrop backdrop = BackdropOf(document);
  backdrop.depth = Share(std::move(closed.relief));
  backdrop.sigma = closed.sigma.empty() ? nullptr : Share(std::move(closed.sigma));
  backdrop.origin = closed.origin.empty() ? nullptr : Share(std::move(closed.origin));
  SetMeasuredDepth(state, "Mark wrong depth", backdrop);
  state.message = fmt::format("{} cells were marked as wrong and are interpolated.", marked);
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
  SetMeasuredDepth(state, fmt::format("Set the scale by {:g} mm", MmFromMetres(chosen.metres)),
                   backdrop);
  chosen.is_given = true;
  state.message = fmt::format(
      "The scale changed: the radius of the backdrop was {:.1f} mm and is {:.1f} mm "
      "(factor {:.3f}).",
      MmFromMetres(before), MmFromMetres(backdrop.radius), factor);
}

void ForgetLengths(EditorState& state) {
  DepthBoard& board = state.steps.depth->board;
  for (LengthPick* length : {&board.tissue, &board.instrument}) {
    length->points = {};
    length->is_given = false;
  }
}

void KeepDepthBoardFresh(EditorState& state) {
  DepthBoard& board = state.steps.depth->board;
  const Document& document = state.document();
  DepthBoard::Drawn& drawn = board.drawn;
  if (drawn.panorama != document.panorama) {
    board.read.reset();
    board.profile = {};
    board.stroke.clear();
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
                       drawn.radius == radius;
  if (is_same) return;
  drawn.panorama = document.panorama;
  drawn.depth = document.depth;
  drawn.sigma = document.depth_sigma;
  drawn.origin = document.depth_origin;
  drawn.layer = board.layer;
  drawn.radius = radius;
  DrawnLayer layer = DrawLayer(document, board.layer);
  drawn.picture = std::make_shared<const ColourImage>(std::move(layer.picture));
  drawn.legend = std::move(layer.legend);
}

}  // namespace arthro::app
