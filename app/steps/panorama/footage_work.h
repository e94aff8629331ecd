// From a clip to the backdrop: everything that the Panorama step can have done with footage. The
// long parts run beside the window (jobs.h) and tell how far they are by mail; the results are
// taken over here, in the window's thread.
#pragma once

#include <filesystem>
#include <functional>

#include "app/steps/panorama/panorama_step.h"

namespace arthro::authoring {
struct PanoramaRequest;
}

namespace arthro::app {

struct FootageClip;

// ---- The clip. ----
void BrowseForFootage(EditorState& state);
// Reads the clip's frames as small pictures. A picture stands for the folder that it lies in.
// Until the first frame was read, what was on the board stays.
void OpenFootage(EditorState& state, const std::filesystem::path& file);
// The same with all of the board's clips and one more.
void BrowseForJoined(EditorState& state);
void JoinFootage(EditorState& state, const std::filesystem::path& file);
// Asks for a new folder, makes a digital knee with its footage, grid and lens in it, and opens the
// footage. The knee is always the same.
void BrowseForPhantom(EditorState& state);
void MakePhantomFootage(EditorState& state, const std::filesystem::path& folder);
// Reads the clip of a reopened scene, which must be the one that its panorama was made from.
void ReadFootageAgain(EditorState& state);
// Asks where the clip of a reopened scene lies now.
void BrowseForMissing(EditorState& state);
void FindFootage(EditorState& state, const std::filesystem::path& file);
void CloseFootage(EditorState& state);
// True for the name of a video, or for a folder with pictures that is not a scene.
bool LooksLikeFootage(const std::filesystem::path& file);

// ---- What the next run will use. ----
void SetFootageLens(EditorState& state, int choice);
void BrowseForLens(EditorState& state);
void SetPanoramaOptions(EditorState& state, const authoring::PanoramaOptions& options);
// Whether the next run tries to measure the relief from the motion of the scope.
void SetMeasuresRelief(EditorState& state, bool measures);
void SetFrameIncluded(EditorState& state, int frame, bool included);

// ---- Mending by hand. Each is a step of the history where the board shows the scene's own clip.
// ----
void SetTool(EditorState& state, BoardTool tool);
// A pair from a raw pixel of the selected frame to a pixel of the panorama on the board.
void AddTie(EditorState& state, const glm::dvec2& raw, const glm::dvec2& panorama);
void RemoveTie(EditorState& state, std::size_t tie);
// Pixel of the board's panorama, which may be a part or the mirror image, for one of its report.
glm::dvec2 ShownPixel(const MadePanorama& made, glm::dvec2 in_report);
void AddMask(EditorState& state, const glm::dvec2& corner, const glm::dvec2& opposite);
void RemoveMask(EditorState& state, std::size_t mask);
// Takes over what the last run found never to change.
bool CanProposeMasks(const EditorState& state);
void ProposeMasks(EditorState& state);

// ---- The run. ----
bool CanRun(const EditorState& state);
bool FootageIsUnderWay(const EditorState& state);  // read or run
void RunFootage(EditorState& state);
// Makes what the last run made the document's backdrop, in one step that can be undone, and opens
// the Depth step.
void UseMadePanorama(EditorState& state);
// The same with the part that was measured, where the clip does not determine depth everywhere.
bool HasMeasuredPart(const EditorState& state);
void UseMeasuredPart(EditorState& state);

// ---- What is looked at. ----
void SelectFrame(EditorState& state, int frame);  // -1: the mosaic; clamped
void StepFrame(EditorState& state, int by);
void SetFrameView(EditorState& state, FrameView view);

// Takes over what jobs told, and has the selected frame read. Once a frame; true when something
// changed.
bool FinishFootage(EditorState& state);

// ---- Among the files of this folder. ----
// Holds the board against the document: a scene that was opened, undo and redo.
void KeepBoardOfScene(EditorState& state);
// Makes left out frames, ties and masks of the board those of the document.
void KeepChoices(EditorState& state, const std::string& name);
void TakeFootageMail(EditorState& state);
void BeginBoard(EditorState& state, const FootageClip& clip);
authoring::PanoramaRequest RequestOf(const FootageBoard& board);  // request of the next run
void NoteNextRun(FootageBoard& board);  // after options, lens, frames or products changed
void ShowMade(FootageBoard& board);     // shows the result of the last finished run

}  // namespace arthro::app
