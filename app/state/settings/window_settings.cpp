#include "app/state/settings/window_settings.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/option_fields.h"

namespace arthro::app {
namespace {

// A laptop's or small desktop's monitor with so many pixels over so few millimetres is dense, also
// where the system reports no scale.
constexpr int kSmallMonitorMm = 400;
constexpr int kDensePx = 2400, kVeryDensePx = 3200;

}  // namespace

double ScaleOf(UiScale choice, const MonitorSize& monitor) {
  switch (choice) {
    case UiScale::k100:
      return 1.0;
    case UiScale::k125:
      return 1.25;
    case UiScale::k150:
      return 1.5;
    case UiScale::k200:
      return 2.0;
    case UiScale::kAutomatic:
      break;
  }
  if (monitor.content_scale > 1.0) return monitor.content_scale;
  if (monitor.width_mm <= 0 || monitor.width_mm >= kSmallMonitorMm) return 1.0;
  return monitor.width_px >= kVeryDensePx ? 2.0 : monitor.width_px >= kDensePx ? 1.5 : 1.0;
}

const char* LanguageCode(LanguageChoice choice) {
  if (choice == LanguageChoice::kGerman) return "de";
  if (choice == LanguageChoice::kEnglish) return "en";
  // The order of gettext; LANGUAGE lists several, the first that is known counts.
  for (const char* name : {"LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"}) {
    const char* value = std::getenv(name);
    if (value == nullptr || *value == '\0') continue;
    for (std::string_view rest = value; !rest.empty();) {
      const std::string_view word = rest.substr(0, rest.find(':'));
      rest.remove_prefix(std::min(word.size() + 1, rest.size()));
      if (word.starts_with("de")) return "de";
      if (word.starts_with("en")) return "en";
    }
    if (std::string_view(name) != "LANGUAGE") return "en";  // C, or a language that is not known
  }
  return "en";
}

WindowSettings ReadWindowSettings(const std::filesystem::path& file) {
  std::error_code ignored;
  if (file.empty() || !std::filesystem::exists(file, ignored)) return {};
  try {
    WindowSettings settings;
    ReadOptionsText(ReadWholeFile(file, kMostJsonBytes), file, settings);
    return settings;
  } catch (const std::exception&) {
    return {};
  }
}

void WriteWindowSettings(const std::filesystem::path& file, const WindowSettings& settings) {
  if (file.empty()) return;
  try {
    std::filesystem::create_directories(file.parent_path());
    WriteAtomically(file, OptionsText(settings, 2) + "\n");
  } catch (const std::exception&) {
    // The next start has what was there.
  }
}

}  // namespace arthro::app
