#include "app/files/scene_files.h"

#include <algorithm>
#include <cctype>

#include "app/platform/resource_folder.h"
#include "app/state/edits.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/lessons/lessons_step.h"
#include "app/steps/panorama/footage_work.h"
#include "app/steps/panorama/panorama_step.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/project/document_io.h"
#include "authoring/project/every_instrument.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/fingerprint.h"
#include "simulation/core/folders/leftovers.h"
#include "simulation/scene/files/archive_io.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;
using authoring::Document;

constexpr const char* kUntitled = "Untitled";

std::string LowerExtension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

Document NewDocument() {
  Document document;
  document.scene.title = kUntitled;
  document.scene.instruments = authoring::EveryInstrument();
  return document;
}

SceneOnDisk NoteOnDisk(const fs::path& scene) {
  // A save writes the folder's scene.json, so that is what counts, whichever file was opened.
  const fs::path file = SceneFile(scene);
  if (!IsArchive(file) && file.filename() != "scene.json") return {};
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return {};
  const std::string mark = FingerprintOf(ReadWholeFile(file));
  const fs::path place = fs::absolute(file);
  return {IsArchive(file) ? place : place.parent_path(), mark};
}

bool HasChangedOnDisk(const EditorState& state, const fs::path& place) {
  std::error_code ignored;
  const fs::path file = IsArchive(place) ? place : place / "scene.json";
  if (!fs::exists(file, ignored)) return false;
  return state.on_disk.place.empty() || !fs::equivalent(state.on_disk.place, place, ignored) ||
         NoteOnDisk(place).fingerprint != state.on_disk.fingerprint;
}

void HoldScene(EditorState& state) {
  state.lock = {};  // its own mark is not another window's
  const fs::path& place = state.document().folder;
  if (state.practice_only || place.empty()) return;
  state.lock = SceneLock(place);
  if (!state.lock.other().empty())
    state.dialogs.push_back(OpenElsewhereDialog{place, state.lock.other()});
  // A session that was killed while it saved left an unfinished file.
  else if (state.lock.is_held())
    RemoveLeftovers(IsArchive(place) ? place.parent_path() : place);
}

void EditCopy(EditorState& state) {
  Document copy = state.document();
  copy.folder.clear();
  const bool was_saved = state.history.IsSaved();
  state.on_disk = {};
  state.lock = {};
  state.history = authoring::History(std::move(copy));
  if (was_saved) state.history.MarkSaved();
}

void StartDocument(EditorState& state, Document document, bool saved, SceneOnDisk on_disk) {
  state.on_disk = std::move(on_disk);
  state.history = authoring::History(std::move(document));
  if (saved) state.history.MarkSaved();
  state.steps.depth->cache.Note(state.document());
  state.tissue = state.document().scene.tissues.empty() ? -1 : 0;
  state.scope = simulation::StartOfScope(state.document().scene);
  state.instrument = simulation::StartOfInstrument(state.document().scene);
  state.practice.reset();
  HoldScene(state);
  state.steps.panorama->shows_footage = false;  // the scene is what was asked for
  ++state.document_number;
}

Document OpenSceneDocument(const fs::path& scene) {
  Document document = authoring::OpenDocument(scene);
  if (IsInResourceFolder(scene)) document.folder.clear();
  return document;
}

void OpenScene(EditorState& state, const fs::path& scene) {
  state.jobs.Start(
      "Open " + scene.filename().string(),
      [scene](const Progress&) {
        // Noted before it is read: a change in between is found when the scene is saved.
        const SceneOnDisk on_disk = NoteOnDisk(scene);
        return [scene, on_disk, document = OpenSceneDocument(scene)](EditorState& now) {
          StartDocument(now, document, true, on_disk);
          if (!IsInResourceFolder(scene)) now.recent.Add(scene);
          now.message = "Opened " + scene.string();
        };
      },
      true);
}

namespace {

enum class IfChanged { kAsk, kReplace };

void SaveInto(EditorState& state, const fs::path& folder, IfChanged if_changed,
              std::function<void(EditorState&)> then) {
  if (IsInResourceFolder(folder))
    throw Error(Code::kBadArgument,
                "the scenes that came with the program stay as they are; choose another folder",
                folder);
  WhenDepthIsReady(state, [folder, if_changed, then = std::move(then)](EditorState& ready) {
    const bool is_changed = HasChangedOnDisk(ready, folder);
    if (is_changed && if_changed == IfChanged::kAsk) {
      ready.dialogs.push_back(ChangedOnDiskDialog{folder, then});
      return;
    }
    authoring::SaveOptions options;
    options.needed_files = ready.history.FilesOnlyOnDisk();
    options.keeps_all_files = is_changed;
    options.keeps_backup = is_changed || !ready.history.IsSaved();
    ready.jobs.Start(
        "Save " + folder.filename().string(),
        [folder, options, then, document = ready.document()](const Progress&) {
          const Document saved = authoring::SaveDocument(document, folder, options);
          return [then, saved, on_disk = NoteOnDisk(saved.folder)](EditorState& now) {
            now.history.MarkSaved(saved);
            now.on_disk = on_disk;
            if (!now.lock.is_held()) HoldScene(now);
            now.steps.depth->cache.Note(saved);
            now.recent.Add(saved.folder);
            now.message = "Saved in " + saved.folder.string();
            if (then) then(now);
          };
        },
        true);
  });
}

// A scene without a title gets the name under which it is saved.
void TakeTitleFrom(EditorState& state, const fs::path& folder) {
  const std::string& title = state.document().scene.title;
  const std::string name = (IsArchive(folder) ? folder.stem() : folder.filename()).string();
  if (name.empty() || (!title.empty() && title != kUntitled)) return;
  Edit(state, "Name the scene", "", [&](Document& next) { next.scene.title = name; });
}

}  // namespace

void SaveScene(EditorState& state, std::function<void(EditorState&)> then) {
  const fs::path folder = state.document().folder;
  if (folder.empty()) return SaveSceneAs(state, std::move(then));
  SaveInto(state, folder, IfChanged::kAsk, std::move(then));
}

void ReplaceChangedScene(EditorState& state, std::function<void(EditorState&)> then) {
  const fs::path folder = state.document().folder;
  if (!folder.empty()) SaveInto(state, folder, IfChanged::kReplace, std::move(then));
}

void SaveSceneAs(EditorState& state, std::function<void(EditorState&)> then) {
  const std::string& title = state.document().scene.title;
  std::string name;
  for (const char c : title.empty() ? std::string("scene") : title) name += c == '/' ? '-' : c;
  Browse(
      state, BrowseFor::kSaveFolder, "Save the scene as a folder, or as a file NAME.arthro", "Save",
      {},
      [then = std::move(then)](EditorState& now, const fs::path& folder) {
        TakeTitleFrom(now, folder);
        SaveInto(now, folder, IfChanged::kReplace, then);  // the browser has asked
      },
      name);
}

void OpenDropped(EditorState& state, const fs::path& file) {
  const std::string extension = LowerExtension(file);
  const auto is_one_of = [&](std::initializer_list<const char*> extensions) {
    return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
  };
  if (LooksLikeFootage(file)) {
    OpenFootage(state, file);
  } else if (is_one_of({".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp"})) {
    ImportPanorama(state, file);
  } else if (is_one_of({".stl", ".obj", ".ply", ".off", ".vtp", ".vtu"})) {
    AskForUnit(state, file);
  } else if (extension == ".attempt") {
    OpenAttemptFile(state, file);
  } else if (fs::is_directory(file) || is_one_of({".json", ".arthro"})) {
    GuardUnsaved(state, "open another scene", [file](EditorState& sure) { OpenScene(sure, file); });
  } else {
    throw Error(
        Code::kBadArgument,
        "nothing that can be dropped; drop a scene, attempt, PNG, JPEG or TIFF picture, video, "
        "folder of frames, STL, OBJ, PLY, OFF or VTP surface, or VTU volume",
        file);
  }
}

}  // namespace arthro::app
