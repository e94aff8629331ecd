#include "app/editor/editor_settings.h"

#include "app/files/recovery_folder.h"
#include "app/platform/resource_folder.h"
#include "app/state/settings/recent_scenes.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/options_json.h"

namespace arthro::app {
namespace {

std::filesystem::path OwnFile(const EditorOptions& options, const char* name) {
  if (options.script || options.frames > 0 || RecentScenesFile().empty()) return {};
  return RecentScenesFile().replace_filename(name);
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

}  // namespace arthro::app
