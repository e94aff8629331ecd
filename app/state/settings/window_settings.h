// The window's looks and language, as its user has set them: kept between runs in the user's
// configuration folder, and flags of the jobs that open a window.
#pragma once

#include <filesystem>

#include "app/platform/monitor_size.h"
#include "simulation/core/options.h"

namespace arthro::app {

enum class UiScale { kAutomatic, k100, k125, k150, k200 };
enum class ThemeChoice { kDark, kLight };
enum class LanguageChoice { kAutomatic, kEnglish, kGerman };
// Fineness of the scope's picture while it moves: by the speed of the machine, at most without its
// soft shade, at most kSmallScale of its edge. A still picture is always complete.
enum class MovingPicture { kAutomatic, kPlain, kSmall };
inline constexpr double kSmallScale = 0.7;

struct WindowSettings {
  UiScale interface_scale = UiScale::kAutomatic;
  ThemeChoice theme = ThemeChoice::kDark;
  LanguageChoice language = LanguageChoice::kAutomatic;
  MovingPicture moving_picture = MovingPicture::kAutomatic;

  template <class V>
  void Visit(V&& v) {
    v("interface_scale", interface_scale,
      Choices<UiScale>{{{UiScale::kAutomatic, "auto"},
                        {UiScale::k100, "1"},
                        {UiScale::k125, "1.25"},
                        {UiScale::k150, "1.5"},
                        {UiScale::k200, "2"}}},
      "", "Size of text and controls; auto follows the monitor.");
    v("theme", theme,
      Choices<ThemeChoice>{{{ThemeChoice::kDark, "dark"}, {ThemeChoice::kLight, "light"}}}, "",
      "Colours of the window; pictures keep their black ground.");
    v("language", language,
      Choices<LanguageChoice>{{{LanguageChoice::kAutomatic, "auto"},
                               {LanguageChoice::kEnglish, "english"},
                               {LanguageChoice::kGerman, "german"}}},
      "", "Language of the window; auto follows LANGUAGE, LC_ALL, LC_MESSAGES and LANG.");
    v("moving_picture", moving_picture,
      Choices<MovingPicture>{{{MovingPicture::kAutomatic, "auto"},
                              {MovingPicture::kPlain, "plain"},
                              {MovingPicture::kSmall, "small"}}},
      "",
      "Fineness of the scope's picture while it moves: auto follows the machine's speed, plain "
      "leaves out the soft shade, small halves the pixels too.");
  }
  friend bool operator==(const WindowSettings&, const WindowSettings&) = default;
};

// Scale of text and controls. A monitor whose system reports a content scale of 1 and has at least
// 3200 px over less than 400 mm counts as 2, at least 2400 px as 1.5.
double ScaleOf(UiScale choice, const MonitorSize& monitor);

// "de" or "en": the choice, or the first language of the environment's that is known.
const char* LanguageCode(LanguageChoice choice);

// Defaults where the file cannot be read; not being able to write is not worth a word.
WindowSettings ReadWindowSettings(const std::filesystem::path& file);
void WriteWindowSettings(const std::filesystem::path& file, const WindowSettings& settings);

}  // namespace arthro::app
