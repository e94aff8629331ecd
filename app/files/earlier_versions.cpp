#include "app/files/earlier_versions.h"

#include "app/files/recovery_folder.h"
#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/depth/depth_step.h"
#include "authoring/project/document_io.h"
#include "simulation/core/error.h"

namespace arthro::app {

using authoring::SceneVersion;

std::string WordsOfVersion(const SceneVersion& version) {
  return version.name.empty() ? "Save of " + WordsOfTime(version.time) : version.name;
}

void OpenHistory(EditorState& state) {
  HistoryDialog dialog;
  const auto& folder = state.document().folder;
  if (!folder.empty()) dialog.versions = authoring::VersionsOf(folder);
  state.dialogs.push_back(std::move(dialog));
}

void GoToStep(EditorState& state, int step) {
  EndDrag(state);
  state.history.GoTo(step);
  state.message = "Went to: " + state.history.StepName();
}

void ReturnToVersion(EditorState& state, const SceneVersion& version) {
  const std::string words = WordsOfVersion(version);
  state.jobs.Start(
      "Read " + words,
      [version, words](const Progress&) {
        return [words, read = authoring::OpenDocument(version.file)](EditorState& now) {
          authoring::Document next = read;
          next.folder = now.document().folder;
          // The folder's own keys belong to the scene that is saved there now.
          next.scene.extensions.erase("x-snapshot");
          Edit(now, "Return to: " + words, "", [&](auto& document) { document = next; });
          now.steps.depth->cache.Note(now.document());
          now.tissue = now.document().scene.tissues.empty() ? -1 : 0;
        };
      },
      true);
}

void KeepSnapshotOf(EditorState& state, const std::string& name) {
  SaveScene(state, [name](EditorState& now) {
    Guarded(now, "Snapshot", [&] {
      authoring::KeepSnapshot(now.document().folder, name);
      now.message = "Kept the snapshot \"" + name + "\" in " + now.document().folder.string();
    });
  });
}

}  // namespace arthro::app
