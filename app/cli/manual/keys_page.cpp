#include "app/cli/manual/keys_page.h"

#include <fmt/format.h>

#include "app/editor/every_step.h"
#include "app/editor/help/key_list.h"

namespace arthro::app {

std::string KeysPage() {
  std::string page =
      "# Keys and mouse\n\nThe window shows the same list: **Help**, then this page, or "
      "`Shift+F1`. "
      "Letters and digits act\nwhile no text is typed.\n";
  for (const KeyGroup& group : KeyGroups(AllCommands())) {
    page += fmt::format("\n## {}\n| key or mouse | effect |\n|---|---|\n", group.heading);
    for (const KeyRow& row : group.rows) page += fmt::format("| {} | {} |\n", row.keys, row.words);
    if (!group.note.empty()) page += "\n" + group.note + "\n";
  }
  page +=
      "\n## Commands that take arguments in a script\n\n`do` runs a command by its name. "
      "`arthroscene run --list` names all of them. Pixels are those of the\npanorama, and of a raw "
      "frame for `mask` and the first point of `tie`.\n\n| line of a script | effect "
      "|\n|---|---|\n";
  for (const Command& command : AllCommands()) {
    if (*command.arguments == '\0') continue;
    std::string form = command.arguments;
    for (std::size_t at = 0; (at = form.find('|', at)) != std::string::npos; at += 2)
      form.insert(at, 1, '\\');
    page += fmt::format("| `do {} {}` | {} |\n", command.id, form, command.help);
  }
  return page;
}

}  // namespace arthro::app
