// Flags of practise that open the window on an exercise for a trainee.
#pragma once

#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace arthro::app {

struct EditorOptions;

// --exercise, --trainee and --test. `options` outlives `job`.
void AddLessonFlags(CLI::App& job, EditorOptions& options);

// Refuses an exercise that the scene does not have and a trainee whom nobody knows, before there is
// a window. Records that are not reached leave a notice in `options`; the attempt is kept in the
// outbox then. Throws Error.
void CheckLesson(EditorOptions& options);

}  // namespace arthro::app
