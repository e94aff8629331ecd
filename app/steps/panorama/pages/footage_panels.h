// The Panorama step's pages for footage: its controls beside, its pictures on the board. Free
// functions over the editor's state, which they change only through commands and edits.
#pragma once

#include <functional>

#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/steps/panorama/panorama_step.h"

namespace arthro::app {

// Clip, lens, options, run and result.
void FootagePanel(Ui& ui, EditorState& state);

// The large picture, the line of all frames and the strip of small pictures. `texture` gives a
// picture's OpenGL texture, first row at v = 0; it is asked for those in sight only.
using TextureOf = std::function<unsigned(const SharedPicture&)>;
void FootageBoardPage(Ui& ui, EditorState& state, const Area& area, const TextureOf& texture);

// The panorama of the scene while it is cropped, scaled or turned, and the fields beside it.
void AdjustFields(Ui& ui, EditorState& state);
void AdjustBoardPage(Ui& ui, EditorState& state, const Area& area, const TextureOf& texture);

// ---- Parts of the board. ----
unsigned ColourOf(FrameStatus status);   // 0xAABBGGRR
const char* SignOf(FrameStatus status);  // so that colour is not all there is
const char* ToString(FrameStatus status);

// Tie points and masks; on the controls' side, and in the place of the large picture.
void MendFields(Ui& ui, EditorState& state);
bool ShowsMendPicture(const FootageBoard& board);
void MendPicture(Ui& ui, EditorState& state, const Area& area, const TextureOf& texture);

void LargePicture(Ui& ui, EditorState& state, const Area& area, const TextureOf& texture);
// Camera poses and tissue points, from above and from the side.
void MotionPicture(Ui& ui, const authoring::ReliefSoFar& so_far, const Area& area);
void FrameLine(Ui& ui, EditorState& state, const Area& area);  // one mark per frame, the whole clip
void FrameStrip(Ui& ui, EditorState& state, const Area& area, const TextureOf& texture);
float FrameStripHeight(const Ui& ui);

}  // namespace arthro::app
