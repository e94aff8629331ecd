// The recording of a practice, as a film or as pictures of what the scope shows: begun and ended by
// a command, and ended with the practice. It runs in the session's own time, so a pause for a
// dialog is cut out.
#pragma once

#include <filesystem>

#include "app/steps/practice/practice_step.h"

namespace arthro::app {

// The pattern of the numbered pictures that a chosen .png stands for: practice-%04d.png. Other
// files and patterns as they are.
std::filesystem::path NumberedPictures(const std::filesystem::path& file);
// Asks where, or ends the one that runs.
void ToggleFilm(EditorState& state);
bool MayToggleFilm(const EditorState& state);
// Throws Error where it cannot be written there. Only while a practice runs and no film does.
void BeginFilm(EditorState& state, const std::filesystem::path& file);

double FilmSeconds(const EditorState& state);  // length of the running film, s

// Once a frame: ends it where its practice ended, and says what became of it. True: it said so.
bool FinishFilm(EditorState& state);

}  // namespace arthro::app
