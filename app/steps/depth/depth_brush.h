// The brush that mends the depth map: its settings and the stroke under way. A stroke is one step
// of the history. While the button is down its effect is shown on a coarse copy of the map. Points
// are pixels of the panorama.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/state/editor_state.h"
#include "authoring/alignment/scene_point.h"
#include "authoring/depth/strokes/growing_stroke.h"

namespace arthro::app {

struct DepthBrush {
  authoring::DepthStroke stroke;  // kind and size; its points while the button is down
  bool is_down() const { return !stroke.points.empty(); }

  // The stroke under way on a coarse copy of the map. Null: no stroke.
  std::shared_ptr<authoring::GrowingStroke> growing;
  std::shared_ptr<const ColourImage> coarse_picture;  // same size as its maps
  // Copy of the document's maps, made beside the window while the button is down, and the map that
  // it is a copy of: 64 MB at 4096 x 2048. Let go, the stroke changes only its own tiles of it.
  std::future<authoring::MendedDepth> copy;
  std::shared_ptr<const DepthMap> copy_of;
  int stride = 1;                     // pixels of the panorama per coarse pixel
  PixelBounds changed;                // part of the coarse map
  PixelBounds fresh;                  // part of it that was not drawn yet
  long computed = 0;                  // coarse pixels of all pieces of the stroke
  long version = 0;                   // grows with each change of the stroke
  std::optional<glm::dvec2> pointed;  // px of the panorama under the pointer in a picture
};

// True while drags over the map, the scope's picture and the overview paint.
bool PaintsDepth(const EditorState& state);
void LeaveDepthBrush(EditorState& state);

double BrushRadius(const EditorState& state);  // px of the panorama
void SetBrushRadius(EditorState& state, double pixels);
// Radius on the tissue at a pixel, m; nothing where no depth is known.
std::optional<double> BrushRadiusOnTissue(const EditorState& state, const glm::dvec2& pixel);

// Takes the place where a line of sight of the scope's picture or the overview meets the relief:
// the brush's ring or the touch preview lies there, and a held button paints.
void PointAtRelief(EditorState& state, const authoring::Sight& sight, bool paints);
// The ring lasts for one frame.
void ForgetPointer(EditorState& state);
// Circle on the relief about the pointed place, with this share of the brush's radius. Portal
// frame, m; gaps where no depth is known.
std::vector<std::optional<glm::dvec3>> RingOnRelief(const EditorState& state, double share);

// Begins or continues the stroke.
void PaintDepth(EditorState& state, const glm::dvec2& pixel);
// Applies the stroke to the document in one step that is undone.
void EndStroke(EditorState& state);
void CancelStroke(EditorState& state);

// Strokes that the document holds.
int StrokeCount(const EditorState& state);
// Shows the map as it was before all strokes. A map of a scene of an earlier version holds them for
// good.
bool CanRemoveStrokes(const EditorState& state);
void RemoveStrokes(EditorState& state);

// "Raise".
const char* WordOf(authoring::StrokeKind kind);

}  // namespace arthro::app
