// A page of the manual as the window shows it: headings, paragraphs, lists, tables and listings of
// its Markdown. Pictures are left out; a link is its words.
#pragma once

#include <string>

#include "app/panels/widgets.h"

namespace arthro::app {

void ManualPage(Ui& ui, const std::string& markdown);

}  // namespace arthro::app
