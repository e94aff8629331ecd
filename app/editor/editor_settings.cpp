#include "app/editor/editor_settings.h"

#include <memory>

#include "app/editor/every_step.h"
#include "app/files/recovery_folder.h"
#include "app/files/scene_files.h"
#include "app/files/start_page.h"
#include "app/platform/resource_folder.h"
#include "app/state/settings/recent_scenes.h"
#include "app/steps/lessons/lessons_step.h"
#include "app/steps/panorama/panorama_step.h"
#include "app/steps/practice/film.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/practice/start_practice.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/options_json.h"

namespace arthro::app {
namespace {

std::filesystem::path OwnFile(const EditorOptions& options, const char* name) {
  if (options.script || options.frames > 0 || RecentScenesFile().empty()) return {};
  return RecentScenesFile().replace_filename(name);
}

void BeginPractice(const EditorOptions& options, EditorState& state) {
  if (!MayPractise(state)) return;
  StartPractice(state, [film = options.film](EditorState& now) {
    if (film) BeginFilm(now, *film);
  });
}

}  // namespace

WindowOptions WindowFrom(const EditorOptions& options, double frame_time) {
  WindowOptions window;
  window.width = options.width, window.height = options.height;
  window.visible = !options.hidden;
  window.scale = options.scale;
  if (const UiScale chosen = SettingsFrom(options).interface_scale; chosen != UiScale::kAutomatic)
    window.scale = ScaleOf(chosen, {});
  if (options.script) window.fixed_step = frame_time;
  return window;
}

std::filesystem::path FolderOfCopies(const EditorOptions& options) {
  if (options.practice) return {};
  if (options.recovery) return *options.recovery;
  return options.script || options.frames > 0 ? std::filesystem::path() : RecoveryFolder();
}

std::filesystem::path FileOfViews(const EditorOptions& options) {
  return OwnFile(options, "views.json");
}

std::filesystem::path FileOfSettings(const EditorOptions& options) {
  return OwnFile(options, "settings.json");
}

std::optional<std::string> RecordsFor(const EditorOptions& options) {
  if (options.records || !(options.script || options.frames > 0)) return options.records;
  return "";
}

WindowSettings SettingsFrom(const EditorOptions& options) {
  WindowSettings settings = ReadWindowSettings(FileOfSettings(options));
  ReadOptions(nlohmann::json(options.look), {}, settings);
  return settings;
}

double ScaleFrom(const EditorOptions& options, const WindowSettings& settings,
                 const MonitorSize& monitor) {
  return options.scale && settings.interface_scale == UiScale::kAutomatic
             ? *options.scale
             : ScaleOf(settings.interface_scale, monitor);
}

Translation TranslationFrom(const EditorOptions& options, const WindowSettings& settings) {
  const bool is_free = settings.language == LanguageChoice::kAutomatic;
  const std::string language = options.script && is_free ? "en" : LanguageCode(settings.language);
  const auto file = ResourceFolder() / "languages" / (language + ".po");
  if (!std::filesystem::exists(file)) return {};
  return Translation(ParsePo(ReadWholeFile(file), file));
}

void BeginFrom(const EditorOptions& options, EditorState& state) {
  state.views = ReadViewLayout(FileOfViews(options));
  state.settings = SettingsFrom(options);
  state.practice_only = options.practice;
  if (options.scene) {
    const SceneOnDisk on_disk = NoteOnDisk(*options.scene);
    StartDocument(state, OpenSceneDocument(*options.scene), true, on_disk);
  } else if (!options.script && options.frames == 0) {
    ShowStartPage(state);
  } else if (const auto demo = ResourceFolder() / "demo";
             std::filesystem::exists(demo / "scene.json")) {
    StartDocument(state, OpenSceneDocument(demo), true);
  }
  state.steps.practice->hands = std::make_unique<simulation::Hands>(options.hands);
  state.steps.practice->session_options = options.session;
  state.steps.panorama->lens_folder = ResourceFolder() / "presets" / "lenses";
  state.steps.tissue->preset_folder = ResourceFolder() / "presets" / "tissues";
  state.steps.practice->rig_preset_folder = ResourceFolder() / "presets" / "rigs";
  LoadTissuePresets(state);
  if (options.script) state.steps.practice->pace = simulation::TissuePace::kInline;
  if (!options.practice && options.scene)
    state.recent.Add(state.document().folder.empty() ? *options.scene : state.document().folder);
  state.steps.practice->frame_shape = options.frame_shape;
  state.steps.practice->head = options.head;
  state.steps.practice->trainee_screen = {options.trainee_screen.has_value(),
                                          options.trainee_screen.value_or(0), ""};
  if (options.practice && !options.lesson)
    BeginPractice(options, state);
  else
    state.message =
        options.notice.empty() ? "F1 or ? opens the manual at this page." : options.notice;
  OpenLessons(state, RecordsFor(options));
  if (const auto& lesson = options.lesson)
    OpenBriefing(state, lesson->exercise, lesson->trainee, lesson->is_test);
}

}  // namespace arthro::app
