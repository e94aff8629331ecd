// A page of the manual as the window shows it: headings, paragraphs, lists, tables and listings of
// its Markdown. Pictures are left out.
#pragma once

#include <string>

#include "app/panels/widgets.h"

namespace arthro::app {

struct PageUse {
  std::string link;           // target of the link that was pressed; empty: none was
  bool has_scrolled = false;  // the heading of `anchor` was scrolled to
};
// `anchor`: of the heading that is scrolled to (AnchorOfHeading); empty: none.
PageUse ManualPage(Ui& ui, const std::string& markdown, const std::string& anchor = "");

}  // namespace arthro::app
