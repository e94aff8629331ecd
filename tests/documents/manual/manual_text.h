// Pages of the manual (resources/doc/manual) as the tests of it see them: text, names in bold, code
// and listings.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace arthro::test {

struct ManualText {
  std::string name;  // "depth"
  std::string text;
  friend void PrintTo(const ManualText& page, std::ostream* out) { *out << page.name; }
};
// Every page, in the order of their names.
std::vector<ManualText> ManualTexts(const std::filesystem::path& root);

struct Listing {
  std::string info;  // words behind the fence: "sh runnable"
  std::string body;
};
std::vector<Listing> ListingsOf(std::string_view page);
// The page without its listings.
std::string ProseOf(std::string_view page);

// **bold** and `code` of the prose, line ends as blanks.
std::vector<std::string> BoldOf(std::string_view page);
std::vector<std::string> CodeOf(std::string_view page);

// Commands that a page names: lines of its sh listings and code of its prose that begin with the
// program or a flag, as words.
std::vector<std::vector<std::string>> CommandLinesOf(std::string_view page);

// Targets of links, without those to other sites: "depth.md", "../method.md#reach".
std::vector<std::string> LinksOf(std::string_view page);

// Anchor that a heading has in HTML: "Depth from brightness" is "depth-from-brightness".
std::string AnchorOf(std::string_view heading);
std::vector<std::string> AnchorsOf(std::string_view page);

}  // namespace arthro::test
