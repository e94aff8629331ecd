// Begin of a window as its options and the user's files ask for it: size, looks, language, the
// files that it keeps, and what it opens on. Scripts and single frames read and leave nothing of
// the user's, unless they are told where.
#pragma once

#include <filesystem>

#include "app/editor/editor.h"
#include "app/platform/monitor_size.h"
#include "app/platform/translation.h"
#include "app/platform/window.h"
#include "app/state/settings/window_settings.h"

namespace arthro::app {

// The window opens at the interface scale that was chosen. `frame_time`: s, step of a script's
// frames, which are the same whatever the machine's speed.
WindowOptions WindowFrom(const EditorOptions& options, double frame_time);
// Folder of copies of unsaved work; empty: none.
std::filesystem::path FolderOfCopies(const EditorOptions& options);
// Files beside that of the recent scenes; empty: none.
std::filesystem::path FileOfViews(const EditorOptions& options);
std::filesystem::path FileOfSettings(const EditorOptions& options);
// Place of the records of attempts; empty: nothing is kept; none: those of the user.
std::optional<std::string> RecordsFor(const EditorOptions& options);
WindowSettings SettingsFrom(const EditorOptions& options);
double ScaleFrom(const EditorOptions& options, const WindowSettings& settings,
                 const MonitorSize& monitor);
// A script that names no language is in English, whatever the environment.
Translation TranslationFrom(const EditorOptions& options, const WindowSettings& settings);

// Opens the scene or the start page, takes the devices, begins a practice or shows the briefing of
// an exercise. Throws Error for a scene that cannot be read and an exercise that is not there.
void BeginFrom(const EditorOptions& options, EditorState& state);

}  // namespace arthro::app
