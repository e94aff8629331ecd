// The manual as the program finds it, and the reference pages that its index links. Pages are
// Markdown texts among the program's own files; the same pages with pictures, as HTML, are in the
// package arthroscene-doc or made by packaging/manual.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace arthro::app {

struct HelpPage {
  std::string name;   // "depth"
  std::string title;  // its first heading
};

// Every page in the order in which the index links them, which is the first.
// Throws Error(kFile) where the manual is not installed.
std::vector<HelpPage> HelpPages();

// Target of a link: another page, or a file or an address beyond them.
struct HelpLink {
  std::string page;    // name in HelpPages; empty: `target` is none of them
  std::string anchor;  // heading of the page (AnchorOfHeading); empty: its beginning
  std::string target;  // path of the file, or address
};
HelpLink LinkFrom(const std::string& page, const std::string& target);

// Anchor of a heading, as GitHub and pandoc write it: "Depth map" is "depth-map".
std::string AnchorOfHeading(std::string_view heading);

// Names of the other pages that a page links, each once, in their order.
std::vector<std::string> PagesLinkedFrom(const std::string& page, const std::string& text);

// The text of a page. Throws Error(kBadData) that lists the pages where there is none of this name.
std::string HelpText(const std::string& name);

// The HTML of a page, where it is on this machine.
std::optional<std::filesystem::path> HelpInHtml(const std::string& name);

// One sentence on where the manual with pictures lies, or how to get it.
std::string WhereTheManualIs();

// File with the texts of the libraries' licences: among the program's own files, or in the folder
// that the program was built in. Empty where there is none.
std::filesystem::path LicenceTexts();

// Opens a file or an address by the program that the desktop has for it, without waiting for it.
// False where there is none.
bool OpenOnDesktop(const std::filesystem::path& file);

}  // namespace arthro::app
