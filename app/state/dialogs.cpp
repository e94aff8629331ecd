#include "app/state/dialogs.h"

#include <cstdlib>
#include <system_error>
#include <utility>

#include "app/platform/resource_folder.h"
#include "app/state/editor_state.h"

namespace arthro::app {

namespace fs = std::filesystem;

void Browse(EditorState& state, BrowseFor purpose, const std::string& title,
            const std::string& accept_words, std::vector<FileFilter> filters,
            std::function<void(EditorState&, const fs::path&)> then, const std::string& file_name) {
  std::error_code ignored;
  fs::path start = state.document().folder;
  if (start.empty() && !state.recent.Existing().empty())
    start = state.recent.Existing().front().parent_path();
  if (start.empty()) start = fs::current_path(ignored);
  // A scene is a folder: a copy goes beside it, not into it.
  if (purpose == BrowseFor::kSaveFolder && fs::exists(start / "scene.json", ignored))
    start = start.parent_path();
  // The program's own scenes are not replaced.
  if (purpose == BrowseFor::kSaveFolder && IsInResourceFolder(start)) {
    const char* home = std::getenv("HOME");
    start = home != nullptr && *home != '\0' ? fs::path(home) : fs::current_path(ignored);
  }
  state.dialogs.push_back(BrowseDialog{
      title, accept_words, FileBrowserModel(purpose, std::move(filters), start, file_name),
      std::move(then), false, false, false, ""});
}

void GuardUnsaved(EditorState& state, const std::string& action,
                  std::function<void(EditorState&)> then) {
  if (state.practice_only || state.history.IsSaved()) return then(state);
  state.dialogs.push_back(GuardDialog{action, std::move(then)});
}

}  // namespace arthro::app
