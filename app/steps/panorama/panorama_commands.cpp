// Import a panorama, or make one from footage.
#include <algorithm>
#include <array>
#include <vector>

#include <GLFW/glfw3.h>

#include "app/state/edits.h"
#include "app/steps/panorama/adjust_board.h"
#include "app/steps/panorama/footage_work.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

using State = EditorState;

const std::vector<FileFilter>& PictureFilters() {
  static const std::vector<FileFilter> filters = {
      {"Pictures", {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp"}}, {"All files", {}}};
  return filters;
}

// Forms of the arguments in a script.
constexpr const char* kRectangle = "LEFT TOP RIGHT BOTTOM";
constexpr const char* kArrow = "FROM_X FROM_Y TO_X TO_Y";
constexpr const char* kLengthOfLine = "MM FROM_X FROM_Y TO_X TO_Y";
constexpr const char* kTiedPoints = "FRAME_X FRAME_Y PANORAMA_X PANORAMA_Y";

constexpr const char* FormOf(AdjustTool tool) {
  return tool == AdjustTool::kCrop ? kRectangle : kArrow;
}

template <AdjustTool tool>
void UseTool(State& state) {
  state.step = Step::kPanorama;
  SetAdjustTool(state, tool);
}

// Sets the tool's two points as the mouse would give them, px of the panorama.
void AdjustBetween(State& state, AdjustTool tool, const glm::dvec2& from, const glm::dvec2& to) {
  AdjustBoard& board = state.steps.panorama->adjust;
  board.tool = tool;
  board.from = from;
  board.to = to;
  try {
    ApplyAdjustment(state);
  } catch (...) {
    board.tool = AdjustTool::kNone;
    throw;
  }
}

template <AdjustTool tool>
void Adjust(State& state, const CommandArguments& arguments) {
  const auto x = NumbersOf(arguments, FormOf(tool));
  AdjustBetween(state, tool, {x[0], x[1]}, {x[2], x[3]});
}

void SetKnownLength(State& state, const CommandArguments& arguments) {
  const auto x = NumbersOf(arguments, kLengthOfLine);
  if (!(x[0] > 0)) throw Error(Code::kBadArgument, "the length is not above 0 mm");
  state.steps.panorama->adjust.millimetres = x[0];
  AdjustBetween(state, AdjustTool::kLength, {x[1], x[2]}, {x[3], x[4]});
}

void SetSide(State& state, const CommandArguments& arguments) {
  constexpr std::array<const char*, 3> kWords = {"unknown", "left", "right"};
  const auto found = std::find(kWords.begin(), kWords.end(), arguments.front());
  if (arguments.size() != 1 || found == kWords.end())
    throw Error(Code::kBadArgument, "write left, right or unknown after it");
  const auto side = static_cast<BodySide>(found - kWords.begin());
  Edit(state, "Change the side", "", [&](auto& next) { next.scene.side = side; });
}

bool HasTiedFrame(const State& state) {
  const auto& footage = state.steps.panorama->footage;
  return Idle(state) && footage && footage->made && footage->selected >= 0;
}

void TieFrame(State& state, const CommandArguments& arguments) {
  const auto x = NumbersOf(arguments, kTiedPoints);
  AddTie(state, {x[0], x[1]}, {x[2], x[3]});
}

void MaskFrames(State& state, const CommandArguments& arguments) {
  const auto x = NumbersOf(arguments, kRectangle);
  AddMask(state, {x[0], x[1]}, {x[2], x[3]});
}

constexpr Command kPanoramaCommands[] = {
    {"import-panorama",
     "Import a panorama…",
     "Make a picture the backdrop.",
     "Scene",
     {GLFW_KEY_I, true},
     {},
     Idle,
     [](State& state) {
       Browse(state, BrowseFor::kOpenFile, "Import a panorama", "Import", PictureFilters(),
              ImportPanorama);
     }},
    {"make-panorama",
     "Make one from a video…",
     "Make a panorama from the frames of a video, or from a folder of pictures.",
     "Scene",
     {GLFW_KEY_M, true},
     {},
     Idle,
     BrowseForFootage},
    {"phantom-footage",
     "Footage of a digital knee…",
     "Make the footage of a computed knee, with its lens, and open it. It takes half a minute.",
     "Scene",
     {},
     {},
     Idle,
     BrowseForPhantom},
    {"run-footage",
     "Run",
     "Make the panorama. The last one is kept until this one is complete.",
     "Scene",
     {GLFW_KEY_R, true},
     {},
     [](const State& state) { return InEditor(state) && CanRun(state); },
     RunFootage,
     "Nothing has changed since the last run, or no footage is chosen."},
    {"use-panorama",
     "Use this panorama",
     "Make it the backdrop of the scene, and go to the Depth step.",
     "Scene",
     {},
     {},
     [](const State& state) {
       return Idle(state) && state.steps.panorama->footage && state.steps.panorama->footage->made;
     },
     UseMadePanorama,
     "First make a panorama from footage."},
    {"use-measured-part",
     "Use the measured part",
     "Make the part that was measured the backdrop of the scene; the rest is estimated.",
     "Scene",
     {},
     {},
     [](const State& state) { return Idle(state) && HasMeasuredPart(state); },
     UseMeasuredPart,
     "No part of the relief was measured."},
    {"measure-relief",
     "Measure the relief",
     "Measure the relief from the motion of the scope before the panorama is made, or do not.",
     "Scene",
     {},
     {},
     [](const State& state) { return Idle(state) && state.steps.panorama->footage; },
     [](State& state) {
       SetMeasuresRelief(state, !state.steps.panorama->footage->measures_relief);
     },
     "First choose a video or a folder of pictures."},
    {"mirror-scene",
     "Mirror for the other knee",
     "Mirror picture, depth, tissues, cuts, incisions and side: the same scene of the other knee.",
     "Scene",
     {},
     {},
     [](const State& state) { return Idle(state) && HasPicture(state); },
     MirrorForOtherKnee},
    {"crop",
     "Crop",
     "Keep a rectangle of the panorama and of its depth.",
     "Scene",
     {},
     {},
     HasPictureAndTime,
     UseTool<AdjustTool::kCrop>,
     "",
     FormOf(AdjustTool::kCrop),
     Adjust<AdjustTool::kCrop>},
    {"known-length",
     "Known length",
     "Set the size of the scene by two points and a length.",
     "Scene",
     {},
     {},
     HasPictureAndTime,
     UseTool<AdjustTool::kLength>,
     "",
     kLengthOfLine,
     SetKnownLength},
    {"this-is-up",
     "This is up",
     "Turn the scene so that an arrow on the panorama points up.",
     "Scene",
     {},
     {},
     HasPictureAndTime,
     UseTool<AdjustTool::kUp>,
     "",
     FormOf(AdjustTool::kUp),
     Adjust<AdjustTool::kUp>},
    {"this-is-medial",
     "This is medial",
     "Turn the scene so that an arrow points to the middle of the body.",
     "Scene",
     {},
     {},
     [](const State& state) {
       return HasPictureAndTime(state) && state.document().scene.side != BodySide::kUnknown;
     },
     UseTool<AdjustTool::kMedial>,
     "State the side of the knee below first: medial is right in a right knee.",
     FormOf(AdjustTool::kMedial),
     Adjust<AdjustTool::kMedial>},
    {"side",
     "Side",
     "Side of the body that the scene shows.",
     "Scene",
     {},
     {},
     Idle,
     [](State& state) { state.step = Step::kPanorama; },
     "",
     "left|right|unknown",
     SetSide},
    {"tie",
     "Tie this frame",
     "Tie a point of the chosen frame to a point of the panorama.",
     "Scene",
     {},
     {},
     HasTiedFrame,
     [](State& state) { SetTool(state, BoardTool::kTie); },
     "Make a panorama from footage, and choose one of its frames.",
     kTiedPoints,
     TieFrame},
    {"mask",
     "Mask by hand",
     "Leave a rectangle of every frame out of the panorama.",
     "Scene",
     {},
     {},
     [](const State& state) { return Idle(state) && state.steps.panorama->footage.has_value(); },
     [](State& state) { SetTool(state, BoardTool::kMask); },
     "First choose a video or a folder of pictures.",
     kRectangle,
     MaskFrames},
    {"read-report",
     "Read its report…",
     "Read the middle and focal length of the panorama from its report.",
     "Scene",
     {},
     {},
     [](const State& state) { return Idle(state) && HasPicture(state); },
     [](State& state) {
       Browse(state, BrowseFor::kOpenFile, "Read a panorama's report", "Read",
              {{"Reports", {".json"}}, {"All files", {}}}, ReadPanoramaReport);
     }},
};

}  // namespace

std::span<const Command> PanoramaCommands() { return kPanoramaCommands; }

}  // namespace arthro::app
