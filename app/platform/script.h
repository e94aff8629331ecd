// A text script that drives the window as hands would, one action a line, items by the name that is
// written on them. For GUI tests and for showing a fault again.
//   click | double-click | right-click | hover NAME [DX DY] (its middle, or px at scale 1 from it)
//   drag NAME DX DY [right] (pixels at scale 1) · wheel NAME NOTCHES
//   type TEXT · key ctrl+shift+s · hold KEY FRAMES · set NAME VALUE (a slider, by typing)
//   wait frames N · wait job · shot FILE.png · shot-trainee FILE.png
//   mark NAME (what --timing counts the frames from here on under; "" ends it)
//   expect TEXT · expect not TEXT · expect value NAME TEXT · expect enabled|disabled NAME
//   drop FILE · resize WIDTH HEIGHT · crawl SEED ACTIONS (crawler.h) · close · quit
// A name or text with blanks stands in double quotes; # begins a comment. Pure: no window.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace arthro::app {

enum class ScriptVerb {
  kClick,
  kDoubleClick,
  kRightClick,
  kHover,
  kDrag,
  kWheel,
  kType,
  kKey,
  kHold,
  kSet,
  kWaitFrames,
  kWaitJob,
  kShot,
  kShotTrainee,
  kMark,
  kExpect,
  kExpectNot,
  kExpectValue,
  kExpectEnabled,
  kExpectDisabled,
  kDrop,
  kResize,
  kCrawl,
  kClose,
  kQuit
};

struct ScriptLine {
  int number = 0;  // in the file, from 1
  ScriptVerb verb = ScriptVerb::kQuit;
  std::string name, text;  // name of an item; text that is typed or expected, or a file
  double x = 0, y = 0;  // drag, click from the middle, wheel (y), frames (x), size, seed and steps
  bool right_button = false;
};

// Throws Error(kBadData) with the line's number.
std::vector<ScriptLine> ParseScript(std::string_view text, const std::filesystem::path& file = {});

// "ctrl+shift+s" as GLFW_KEY_… codes, modifiers first. Throws Error(kBadData).
std::vector<int> KeysFromWords(std::string_view words);

}  // namespace arthro::app
