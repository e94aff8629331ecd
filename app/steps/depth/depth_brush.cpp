#include "app/steps/depth/depth_brush.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "app/state/edits.h"
#include "app/steps/depth/depth_step.h"
#include "authoring/relief/editing/relief_view.h"
#include "simulation/scene/shrunk_projection.h"

namespace arthro::app {
namespace {

using authoring::Document;
using authoring::MendedDepth;

constexpr int kLongestPreview = 1024;                  // px of the coarse map
constexpr double kLeastRadius = 2, kMostRadius = 400;  // px
// Points nearer to the last one than this share of the radius add nothing to the line.
constexpr double kSpacing = 0.2;

DepthBrush& BrushOf(EditorState& state) { return state.steps.depth->board.brush; }
const DepthBrush& BrushOf(const EditorState& state) { return state.steps.depth->board.brush; }

// Strokes that mask are seen by the estimator, so the map is made anew.
bool IsMadeAnew(const EditorState& state, const authoring::DepthStroke& stroke) {
  return !state.document().is_depth_imported &&
         (authoring::IsMask(stroke) || state.steps.depth->cache.IsStale(state.document()));
}

MendedDepth CopyOf(const std::shared_ptr<const DepthMap>& depth,
                   const std::shared_ptr<const DepthMap>& sigma,
                   const std::shared_ptr<const OriginMap>& origin) {
  return {*depth, OrEmpty(sigma), OrEmpty(origin)};
}

// The copy that was made while the button was down, where that is of the document as it is now.
MendedDepth TakeCopy(const Document& document, DepthBrush& brush) {
  if (brush.copy.valid() && brush.copy_of == document.depth) return brush.copy.get();
  return CopyOf(document.depth, document.depth_sigma, document.depth_origin);
}

void BeginPreview(const Document& document, DepthBrush& brush) {
  brush.copy_of = document.depth;
  brush.copy = std::async(std::launch::async, CopyOf, document.depth, document.depth_sigma,
                          document.depth_origin);
  const DepthMap& depth = *document.depth;
  const ColourImage& panorama = *document.panorama;
  brush.stride = (std::max(depth.width, depth.height) + kLongestPreview - 1) / kLongestPreview;
  DepthMap coarse(std::max(1, depth.width / brush.stride),
                  std::max(1, depth.height / brush.stride));
  ColourImage picture(coarse.width, coarse.height);
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x) {
      const int column = std::min(x * brush.stride + brush.stride / 2, depth.width - 1),
                row = std::min(y * brush.stride + brush.stride / 2, depth.height - 1);
      coarse.at(x, y) = depth.at(column, row);
      std::copy_n(panorama.at(column, row), 3, picture.at(x, y));
    }
  const double factor = static_cast<double>(panorama.width) / coarse.width;
  const Backdrop& backdrop = document.scene.backdrop;
  brush.coarse_picture = Share(std::move(picture));
  // The stroke's points are shares of the panorama's width, so it fits the coarse map as it is.
  brush.growing = std::make_shared<authoring::GrowingStroke>(
      brush.stroke, brush.coarse_picture, Shrunk(backdrop.projection, factor), backdrop.radius,
      MendedDepth{std::move(coarse), {}, {}});
  brush.changed = brush.fresh = {};
  brush.computed = 0;
}

// Applies the piece of the line that ends at the new point.
void ContinuePreview(DepthBrush& brush, const glm::dvec2& point) {
  const authoring::StrokeReport report = brush.growing->Add({&point, 1});
  brush.changed = Joined(brush.changed, report.box);
  brush.fresh = Joined(brush.fresh, report.box);
  brush.computed += report.read;
  ++brush.version;
}

void EndPreview(DepthBrush& brush) {
  brush.stroke.points.clear();
  brush.growing.reset();
  brush.coarse_picture.reset();
  brush.copy = {};
  brush.copy_of.reset();
  brush.changed = brush.fresh = {};
  ++brush.version;
}

// The first stroke on an imported map keeps the map as it is, with the files that hold it.
void KeepUnmended(Document& document) {
  if (document.unmended.depth) return;
  const Backdrop& backdrop = document.scene.backdrop;
  document.unmended = {document.depth, document.depth_sigma, document.depth_origin,
                       backdrop.depth, backdrop.depth_sigma, backdrop.depth_origin};
  document.depth_strokes = nullptr;
}

bool Fits(const Document& document) {
  return document.panorama && document.depth && document.depth->width == document.panorama->width &&
         document.depth->height == document.panorama->height;
}

}  // namespace

bool PaintsDepth(const EditorState& state) {
  return state.step == Step::kDepth && state.steps.depth->board.tool == MapTool::kBrush &&
         Fits(state.document()) && !state.practice && !state.practice_only;
}

void LeaveDepthBrush(EditorState& state) {
  CancelStroke(state);
  state.steps.depth->board.tool = MapTool::kRead;
}

double BrushRadius(const EditorState& state) {
  const auto& panorama = state.document().panorama;
  return panorama ? BrushOf(state).stroke.radius * panorama->width : 0.0;
}

void SetBrushRadius(EditorState& state, double pixels) {
  if (const auto& panorama = state.document().panorama)
    BrushOf(state).stroke.radius =
        std::min(1.0, std::clamp(pixels, kLeastRadius, kMostRadius) / panorama->width);
}

std::optional<double> BrushRadiusOnTissue(const EditorState& state, const glm::dvec2& pixel) {
  const authoring::ReliefReading at = authoring::ReadRelief(ReliefViewOf(state.document()), pixel);
  if (!std::isfinite(at.range)) return std::nullopt;
  const Projection& projection = state.document().scene.backdrop.projection;
  const glm::dvec3 from = DirectionFromPixel(projection, pixel - glm::dvec2(0.5, 0)),
                   to = DirectionFromPixel(projection, pixel + glm::dvec2(0.5, 0));
  return at.range * BrushRadius(state) * glm::distance(from, to);
}

void PointAtRelief(EditorState& state, const authoring::Sight& sight, bool paints) {
  if (TouchesRelief(state)) TouchAlong(state, sight);
  if (!PaintsDepth(state)) return;
  const auto point = authoring::PointOnRelief(state.document(), sight);
  if (!point) return;
  const auto pixel =
      PixelFromDirection(state.document().scene.backdrop.projection, point->x_in_portal);
  if (!pixel) return;
  BrushOf(state).pointed = pixel;
  if (paints) PaintDepth(state, *pixel);
}

void ForgetPointer(EditorState& state) { BrushOf(state).pointed.reset(); }

std::vector<std::optional<glm::dvec3>> RingOnRelief(const EditorState& state, double share) {
  constexpr int kPoints = 48;
  std::vector<std::optional<glm::dvec3>> ring;
  const auto& middle = BrushOf(state).pointed;
  if (!middle || !PaintsDepth(state)) return ring;
  const authoring::ReliefView view = ReliefViewOf(state.document());
  for (int i = 0; i <= kPoints; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPoints;
    const authoring::ReliefReading at = authoring::ReadRelief(
        view, *middle + share * BrushRadius(state) * glm::dvec2(std::cos(angle), std::sin(angle)));
    ring.push_back(std::isfinite(at.range) ? std::optional(at.point) : std::nullopt);
  }
  return ring;
}

void PaintDepth(EditorState& state, const glm::dvec2& pixel) {
  const Document& document = state.document();
  if (!Fits(document)) return;
  DepthBrush& brush = BrushOf(state);
  const double width = document.panorama->width;
  const glm::dvec2 point = (pixel + 0.5) / width;
  if (!brush.is_down()) {
    BeginPreview(document, brush);
  } else if (glm::distance(brush.stroke.points.back(), point) <
             std::max(kSpacing * brush.stroke.radius, 1 / width)) {
    return;
  }
  brush.stroke.points.push_back(point);
  ContinuePreview(brush, point);
}

void EndStroke(EditorState& state) {
  DepthBrush& brush = BrushOf(state);
  if (!brush.is_down()) return;
  const authoring::DepthStroke stroke = brush.stroke;
  const Document& document = state.document();
  if (!Fits(document)) return EndPreview(brush);
  std::optional<MendedDepth> copy;
  if (!IsMadeAnew(state, stroke)) copy = TakeCopy(document, brush);
  EndPreview(brush);
  const std::string name = std::string("Mend depth: ") + WordOf(stroke.kind);
  const auto add = [&](Document& next) {
    next.depth_strokes = authoring::WithStroke(next.depth_strokes, stroke);
  };
  if (!copy) {
    Edit(state, name, "", add);
    return;
  }
  MendedDepth& mended = *copy;
  const Backdrop& backdrop = document.scene.backdrop;
  const authoring::StrokeReport report = authoring::ApplyStroke(
      stroke, {*document.panorama, backdrop.projection, backdrop.radius}, mended);
  if (report.touched == 0) return;
  Edit(state, name, "", [&](Document& next) {
    if (next.is_depth_imported) KeepUnmended(next);
    add(next);
    next.depth = Share(std::move(mended.relief));
    if (next.depth_sigma) next.depth_sigma = Share(std::move(mended.sigma));
    if (next.depth_origin) next.depth_origin = Share(std::move(mended.origin));
  });
  state.steps.depth->cache.Note(state.document());
}

void CancelStroke(EditorState& state) {
  if (BrushOf(state).is_down()) EndPreview(BrushOf(state));
}

int StrokeCount(const EditorState& state) {
  return static_cast<int>(OrEmpty(state.document().depth_strokes).size());
}

bool CanRemoveStrokes(const EditorState& state) {
  const Document& document = state.document();
  return StrokeCount(state) > 0 && (!document.is_depth_imported || document.unmended.depth);
}

void RemoveStrokes(EditorState& state) {
  if (!CanRemoveStrokes(state)) return;
  Edit(state, "Remove the strokes from the depth map", "", [](Document& next) {
    next.depth_strokes = nullptr;
    if (!next.is_depth_imported) return;
    const authoring::UnmendedDepth unmended = std::exchange(next.unmended, {});
    Backdrop& backdrop = next.scene.backdrop;
    next.depth = unmended.depth;
    next.depth_sigma = unmended.sigma;
    next.depth_origin = unmended.origin;
    backdrop.depth = unmended.depth_file;
    backdrop.depth_sigma = unmended.sigma_file;
    backdrop.depth_origin = unmended.origin_file;
  });
}

const char* WordOf(authoring::StrokeKind kind) {
  using authoring::StrokeKind;
  switch (kind) {
    case StrokeKind::kRaise:
      return "Raise";
    case StrokeKind::kLower:
      return "Lower";
    case StrokeKind::kSmooth:
      return "Smooth";
    case StrokeKind::kFlatten:
      return "Flatten";
    case StrokeKind::kBrightness:
      return "Brightness";
    case StrokeKind::kUnknown:
      return "Unknown";
    case StrokeKind::kEdge:
      return "Edge";
    case StrokeKind::kMask:
      return "Mask";
    case StrokeKind::kKeep:
      return "No glint";
  }
  return "";
}

}  // namespace arthro::app
