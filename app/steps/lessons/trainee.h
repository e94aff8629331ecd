// The trainee of this session in the window, by code, and the trainee's page of exercises.
#pragma once

#include "app/steps/lessons/keeping/start_board.h"
#include "app/steps/lessons/lessons_step.h"

namespace arthro::app {

// Attempts from now on are those of the trainee with this code. A code that nobody has yet waits in
// StartBoard::unknown; a text that is no code leaves StartBoard::fault.
void TakeTraineeCode(EditorState& state, const std::string& code);
// Adds the trainee that waits.
void AddTraineeCode(EditorState& state);
// A code that nobody has, for a new trainee.
void SuggestTraineeCode(EditorState& state);
// Ends the session of the trainee.
void ChangeTrainee(EditorState& state);

// Opens the briefing of an exercise of the scene. A code that was typed and not used is used first;
// one that nobody has yet keeps the page open, so that no attempt is lost for a missed button.
void StartExercise(EditorState& state, int exercise);

// The page as the records have it now; read anew where something changed.
const StartBoard& FreshStartBoard(EditorState& state);

// Why the trainee may not begin the chosen exercise, one sentence; empty: it is open, or no trainee
// is chosen.
std::string WhyShut(const EditorState& state);

}  // namespace arthro::app
