#include "app/editor/help/key_list.h"

#include <algorithm>

#include "app/steps/practice/hand_motion.h"

namespace arthro::app {
namespace {

KeyGroup HandGroup() {
  KeyGroup group{"Hands, while a key is held", {}, {}};
  for (const HandMotion& motion : HandMotions())
    group.rows.push_back({motion.key_words, motion.words});
  group.rows.push_back({"C", "Close the jaws, run the shaver"});
  group.rows.push_back({"V", "Dead-man switch: the devices may push"});
  group.note = "Arrow and page keys move the scope after a click on the picture.";
  return group;
}

// Commands with a key, each group once, in the order of its first command.
void AppendCommands(std::span<const Command> commands, std::vector<KeyGroup>& groups) {
  const std::size_t first = groups.size();
  for (const Command& command : commands) {
    std::string keys = WordsOf(command.shortcut);
    if (keys.empty()) continue;
    if (const std::string other = WordsOf(command.other_shortcut); !other.empty())
      keys += " or " + other;
    auto group = std::find_if(groups.begin() + static_cast<std::ptrdiff_t>(first), groups.end(),
                              [&](const KeyGroup& each) { return each.heading == command.group; });
    if (group == groups.end()) group = groups.insert(group, {command.group, {}, {}});
    group->rows.push_back({keys, command.help});
  }
}

}  // namespace

std::vector<KeyGroup> KeyGroups(std::span<const Command> commands) {
  std::vector<KeyGroup> groups = {{"Over the picture",
                                   {{"Drag", "Swing the scope"},
                                    {"Wheel", "Scope deeper, or back"},
                                    {"Shift+wheel", "Roll the scope"},
                                    {"Right drag", "Swing the instrument"},
                                    {"Ctrl+wheel", "Instrument deeper, or back"},
                                    {"Ctrl+Shift+wheel", "Roll the instrument"}},
                                   {}},
                                  {"Over the overview",
                                   {{"Drag", "Turn it"},
                                    {"Wheel or right drag", "Nearer, or further"},
                                    {"Middle drag", "Shift it"},
                                    {"Drag the handle", "Move the chosen tissue"},
                                    {"Shift+drag the handle", "Turn the chosen tissue"},
                                    {"Drag an arm of the handle", "Move it along an axis"},
                                    {"Drag a ring of the handle", "Turn it about an axis"},
                                    {"Right drag the handle", "Make it larger, or smaller"},
                                    {"Drag the border", "Give one view more room"},
                                    {"Esc", "End holding, cutting and naming by clicks"}},
                                   {}},
                                  {"On the footage's board",
                                   {{"Left, Right", "Frame before, or next"},
                                    {"Page up, Page down", "Ten frames back, or on"},
                                    {"Space, double-click", "Use this frame, or leave it out"},
                                    {"Escape", "Back to the panorama"},
                                    {"Wheel, drag", "Look closer, shift; double-click shows all"}},
                                   {}},
                                  {"On the map of the depth",
                                   {{"Click", "Read a depth, set a point or paint, by the tool"},
                                    {"Drag", "Draw the line of a profile or a length, or paint"},
                                    {"Wheel, right drag", "Look closer, shift"},
                                    {"[, ]", "Smaller brush, larger brush"},
                                    {"Escape", "Leave the brush"}},
                                   {}}};
  groups.push_back(HandGroup());
  AppendCommands(commands, groups);
  groups.push_back({"Anywhere",
                    {{"Drop a file", "Open a scene or a video, import a panorama or a surface"},
                     {"Ctrl+click a slider", "Type its number"},
                     {"?", "The manual's page of what is shown"}},
                    {}});
  return groups;
}

}  // namespace arthro::app
