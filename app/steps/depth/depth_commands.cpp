// Commands of the Depth step.
#include <GLFW/glfw3.h>

#include "app/steps/depth/depth_step.h"

namespace arthro::app {
namespace {

using State = EditorState;

constexpr double kBrushStep = 1.25;

DepthBoard& MapBoard(State& state) { return state.steps.depth->board; }

bool HasBoard(const State& state) { return Idle(state) && HasPicture(state); }

template <MapTool tool>
void TakeTool(State& state) {
  state.step = Step::kDepth;
  MapBoard(state).is_shown = true;
  MapBoard(state).tool = tool;
}

template <MapLayer layer>
void ShowLayer(State& state) {
  state.step = Step::kDepth;
  MapBoard(state).is_shown = true;
  MapBoard(state).layer = layer;
}

constexpr Command kDepthCommands[] = {
    {"depth-map",
     "Map of the depth",
     "Show the depth over the panorama: its origin, its uncertainty, distances and profiles.",
     "Depth",
     {},
     {},
     HasBoard,
     [](State& state) {
       state.step = Step::kDepth;
       MapBoard(state).is_shown = true;
     }},
    {"depth-scope",
     "Scope view",
     "Show the scene through the scope and from outside.",
     "Depth",
     {},
     {},
     HasBoard,
     [](State& state) {
       state.step = Step::kDepth;
       MapBoard(state).is_shown = false;
     }},
    {"map-origin",
     "Origin",
     "Colour each depth by its origin: measured, estimated from brightness or interpolated.",
     "Depth",
     {},
     {},
     HasBoard,
     ShowLayer<MapLayer::kOrigin>},
    {"map-sigma",
     "Uncertainty",
     "Colour each depth by its standard error.",
     "Depth",
     {},
     {},
     HasBoard,
     ShowLayer<MapLayer::kSigma>},
    {"map-range",
     "Distance",
     "Colour each depth by the distance of the tissue from the portal.",
     "Depth",
     {},
     {},
     HasBoard,
     ShowLayer<MapLayer::kRange>},
    {"map-picture",
     "Picture only",
     "Show the panorama without colours.",
     "Depth",
     {},
     {},
     HasBoard,
     ShowLayer<MapLayer::kPicture>},
    {"map-shape",
     "Shape",
     "Show the relief as a grey surface in slanting light.",
     "Depth",
     {},
     {},
     HasBoard,
     ShowLayer<MapLayer::kShape>},
    {"map-masks",
     "Masks",
     "Colour what the depth ignores: glints that were found, and masks that were painted.",
     "Depth",
     {},
     {},
     HasBoard,
     ShowLayer<MapLayer::kMasks>},
    {"map-compare",
     "Side by side",
     "Show grey, filtered grey and relief beside the panorama.",
     "Depth",
     {},
     {},
     HasBoard,
     [](State& state) {
       state.step = Step::kDepth;
       MapBoard(state).is_shown = true;
       MapBoard(state).compares = !MapBoard(state).compares;
     }},
    {"map-read",
     "Read a depth",
     "Click on the map: the distance there with its standard error.",
     "Depth",
     {},
     {},
     HasBoard,
     TakeTool<MapTool::kRead>},
    {"map-length",
     "Give a length",
     "Click on two points whose distance is known; it sets the scale of the scene.",
     "Depth",
     {},
     {},
     HasBoard,
     TakeTool<MapTool::kLength>},
    {"map-profile",
     "Profile",
     "Draw a line on the map: the distance of the tissue along it.",
     "Depth",
     {},
     {},
     HasBoard,
     TakeTool<MapTool::kProfile>},
    {"map-brush",
     "Brush",
     "Paint on the map, in the scope's picture or in the overview to mend the depth.",
     "Depth",
     {},
     {},
     HasBoard,
     [](State& state) {
       state.step = Step::kDepth;
       MapBoard(state).tool = MapTool::kBrush;
       state.steps.depth->touch = {};
     }},
    {"brush-smaller",
     "Smaller brush",
     "Make the brush smaller.",
     "Depth",
     {GLFW_KEY_LEFT_BRACKET},
     {},
     PaintsDepth,
     [](State& state) { SetBrushRadius(state, BrushRadius(state) / kBrushStep); },
     "First take the brush."},
    {"brush-larger",
     "Larger brush",
     "Make the brush larger.",
     "Depth",
     {GLFW_KEY_RIGHT_BRACKET},
     {},
     PaintsDepth,
     [](State& state) { SetBrushRadius(state, BrushRadius(state) * kBrushStep); },
     "First take the brush."},
    {"leave-depth-brush",
     "Leave the brush",
     "Drags turn and move the views again. Escape does the same.",
     "Depth",
     {},
     {},
     PaintsDepth,
     LeaveDepthBrush,
     "The brush is not in use."},
    {"remove-strokes",
     "Remove all strokes",
     "Show the depth map as it is made from the picture, without what was painted.",
     "Depth",
     {},
     {},
     [](const State& state) { return Idle(state) && CanRemoveStrokes(state); },
     RemoveStrokes,
     "Nothing was painted."},
    {"set-scale",
     "Set the scale",
     "Scale the scene so that the distance between the two points is the length that was given.",
     "Depth",
     {},
     {},
     [](const State& state) { return Idle(state) && CanSetScale(state); },
     SetScale,
     "First click on two points whose distance is known, over a depth that was measured or "
     "imported."},
    {"forget-lengths",
     "Forget the lengths",
     "Remove the points and the lengths. The scale stays as it is.",
     "Depth",
     {},
     {},
     [](const State& state) { return HasBoard(state) && HasLengths(state); },
     ForgetLengths,
     "No points and no lengths were given."},
    {"import-depth",
     "Import a depth map…",
     "Take the depth from a grey picture of 8 or 16 bits, or of floating point.",
     "Scene",
     {},
     {},
     HasBoard,
     [](State& state) {
       Browse(state, BrowseFor::kOpenFile, "Import a depth map", "Read",
              {{"Depth maps", {".png", ".tif", ".tiff", ".exr"}}, {"All files", {}}},
              ChooseDepthImport);
     }},
    {"take-depth-import",
     "Use this depth map",
     "Put the depth map of the file in the place of the present one. Undo brings it back.",
     "Scene",
     {},
     {},
     [](const State& state) { return HasBoard(state) && state.steps.depth->import.has_value(); },
     TakeDepthImport,
     "First choose a depth map to import."},
    {"drop-depth-import",
     "Do not import it",
     "Keep the present depth map.",
     "Scene",
     {},
     {},
     [](const State& state) { return state.steps.depth->import.has_value(); },
     [](State& state) {
       state.steps.depth->import.reset();
       state.steps.depth->import_words.clear();
     },
     "No depth map is being imported."},
    {"touch-preview",
     "Touch preview",
     "Point at the tissue: its distance, its normal, its stiffness, and the force on the hand.",
     "Depth",
     {},
     {},
     [](const State& state) { return HasBoard(state) && state.document().depth != nullptr; },
     ToggleTouch,
     "There is no depth yet."},
    {"make-depth",
     "Make depth from the picture",
     "Replace the imported depth map by one that is made from the picture. Undo brings it back.",
     "Scene",
     {},
     {},
     [](const State& state) {
       return Idle(state) && HasPicture(state) && state.document().is_depth_imported;
     },
     MakeDepth,
     "There is no imported depth map to replace."},
};

}  // namespace

std::span<const Command> DepthCommands() { return kDepthCommands; }

}  // namespace arthro::app
