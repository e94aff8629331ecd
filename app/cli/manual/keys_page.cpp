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
  return page;
}

}  // namespace arthro::app
