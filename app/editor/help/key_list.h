// Every key and mouse action of the window, in the groups and the order in which the help page and
// the manual list them. Those of commands and hands come from the lists that also handle them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/state/command.h"

namespace arthro::app {

struct KeyRow {
  std::string keys;   // "Ctrl+Shift+S", "Right drag"
  std::string words;  // effect
};
struct KeyGroup {
  std::string heading;
  std::vector<KeyRow> rows;
  std::string note;  // sentence below the rows; empty: none
};

std::vector<KeyGroup> KeyGroups(std::span<const Command> commands);

}  // namespace arthro::app
