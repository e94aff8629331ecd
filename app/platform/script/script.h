// A text script that drives the window as hands would, one action a line, items by the name that is
// written on them. For GUI tests and for showing a fault again.
//   click | double-click | right-click | hover NAME [DX DY] (its middle, or px at scale 1 from it)
//   drag NAME DX DY [right] (pixels at scale 1) · wheel NAME NOTCHES [DX DY] [shift] [ctrl]
//   stroke NAME [right|middle] [shift] [ctrl] X Y X Y … (one point per frame, px from its middle)
//   do COMMAND [FILE | ARGUMENTS] (`arthroscene run --list` names them)
//   choose FILE (in the file dialog that is open)
//   pose scope|instrument DEPTH LATITUDE LONGITUDE ROLL (m, rad)
//   type TEXT · key ctrl+shift+s · hold KEY FRAMES · set NAME VALUE (a slider, by typing)
//   wait frames N · wait job · shot FILE.png · shot-trainee FILE.png
//   mark NAME (what --timing counts the frames from here on under; "" ends it)
//   expect TEXT · expect not TEXT · expect value NAME TEXT · expect enabled|disabled NAME
//   expect focus NAME · expect tips (of every slider, field and list in sight)
//   expect translated NAME … (every text asked for so far; NAMEs of the data need no entry)
//   expect layout (no control in sight is cut off at its sides or lies over another)
//   walk (Tab, until every control in sight had the focus) · drop FILE · resize WIDTH HEIGHT ·
//   crawl SEED ACTIONS (crawler.h) · close · quit
// A name or text with blanks stands in double quotes; # begins a comment. NAME#2 is the second item
// of that name. An item that is scrolled out of sight is scrolled to. Pure: no window.
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
  kStroke,
  kDo,
  kChoose,
  kPose,
  kWalk,
  kExpectFocus,
  kExpectTips,
  kExpectTranslated,
  kExpectLayout,
  kClose,
  kQuit
};

struct ScriptLine {
  int number = 0;  // in the file, from 1
  ScriptVerb verb = ScriptVerb::kQuit;
  // Name of an item; text that is typed or expected, a file, or the names of data, one per line.
  std::string name, text;
  double x = 0, y = 0;  // drag, click from the middle, wheel (y), frames (x), size, seed and steps
  bool right_button = false;
  int button = 0;  // button of a stroke: 0 left, 1 right, 2 middle
  bool shift = false, ctrl = false;
  std::vector<double> numbers;         // points of a stroke, numbers of a pose
  std::vector<std::string> arguments;  // words after a command
};

// Throws Error(kBadData) with the line's number.
std::vector<ScriptLine> ParseScript(std::string_view text, const std::filesystem::path& file = {});

// A name, text or file as a script writes it: in quotes where it needs them.
std::string ScriptWord(std::string_view text);

// "ctrl+shift+s" as GLFW_KEY_… codes, modifiers first. Throws Error(kBadData).
std::vector<int> KeysFromWords(std::string_view words);

}  // namespace arthro::app
