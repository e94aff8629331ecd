// The manual as the program finds it. Its pages are Markdown texts among the program's own files;
// the same pages with pictures, as HTML, are in the package arthroscene-doc or made by
// packaging/manual.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace arthro::app {

struct HelpPage {
  std::string name;   // "depth"
  std::string title;  // its first heading
};

// Every page in the order in which the index links them, which is the first.
// Throws Error(kFile) where the manual is not installed.
std::vector<HelpPage> HelpPages();

// The text of a page. Throws Error(kBadData) that lists the pages where there is none of this name.
std::string HelpText(const std::string& name);

// The HTML of a page, where it is on this machine.
std::optional<std::filesystem::path> HelpInHtml(const std::string& name);

// One sentence on where the manual with pictures lies, or how to get it.
std::string WhereTheManualIs();

// Opens a file by the program that the desktop has for it, without waiting for it. False where
// there is none.
bool OpenOnDesktop(const std::filesystem::path& file);

}  // namespace arthro::app
