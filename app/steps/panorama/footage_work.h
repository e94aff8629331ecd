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
void TakeFootageMail(EditorState& state);
void BeginBoard(EditorState& state, const FootageClip& clip);
authoring::PanoramaRequest RequestOf(const FootageBoard& board);  // request of the next run
void NoteNextRun(FootageBoard& board);  // after options, lens, frames or products changed
void ShowMade(FootageBoard& board);     // shows the result of the last finished run

}  // namespace arthro::app
