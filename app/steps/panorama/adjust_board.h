// The panorama of the scene on the board, while its author crops it, scales it by a length, or says
// what is up or medial. Every change is one step of the history.
#pragma once

#include <optional>

#include <glm/vec2.hpp>

#include "app/steps/panorama/board/footage_board.h"

namespace arthro::app {

struct EditorState;

enum class AdjustTool { kNone, kCrop, kLength, kUp, kMedial };

struct AdjustBoard {
  AdjustTool tool = AdjustTool::kNone;
  std::optional<glm::dvec2> from, to;  // px of the panorama
  double millimetres = 10;             // between them, for kLength
  // The panorama as it is drawn, and the one that it was drawn from.
  SharedPicture shown, drawn_from;
};

bool ShowsAdjustBoard(const EditorState& state);
// Footage or panorama instead of scope and overview.
bool ShowsPanoramaBoard(const EditorState& state);

void SetAdjustTool(EditorState& state, AdjustTool tool);  // the same one again: none
void KeepAdjustPicture(EditorState& state);  // draws the panorama for the board where it is another
// Does as the two points say, by the tool. Throws Error for what cannot be done.
void ApplyAdjustment(EditorState& state);
void MirrorForOtherKnee(EditorState& state);

}  // namespace arthro::app
