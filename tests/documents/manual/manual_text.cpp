#include "tests/documents/manual/manual_text.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>

#include "tests/documents/source_text.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> WordsOf(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::vector<std::string> MatchesOf(const std::string& text, const std::regex& form) {
  std::vector<std::string> all;
  for (std::sregex_iterator found(text.begin(), text.end(), form), none; found != none; ++found) {
    std::string match = (*found)[1];
    std::replace(match.begin(), match.end(), '\n', ' ');
    all.push_back(match);
  }
  return all;
}

}  // namespace

std::vector<ManualText> ManualTexts(const fs::path& root) {
  std::vector<ManualText> pages;
  for (const auto& entry : fs::directory_iterator(root / "resources/doc/manual"))
    if (entry.path().extension() == ".md")
      pages.push_back({entry.path().stem().string(), TextOf(entry.path())});
  std::ranges::sort(pages, {}, &ManualText::name);
  return pages;
}

std::vector<Listing> ListingsOf(std::string_view page) {
  std::vector<Listing> listings;
  std::istringstream lines{std::string(page)};
  bool is_open = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      is_open = !is_open;
      if (is_open) listings.push_back({line.substr(3), ""});
    } else if (is_open) {
      listings.back().body += line + "\n";
    }
  }
  return listings;
}

std::string ProseOf(std::string_view page) {
  std::string prose;
  std::istringstream lines{std::string(page)};
  bool is_open = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```"))
      is_open = !is_open;
    else if (!is_open)
      prose += line + "\n";
  }
  return prose;
}

std::vector<std::string> BoldOf(std::string_view page) {
  static const std::regex bold(R"(\*\*([^*]+)\*\*)");
  return MatchesOf(ProseOf(page), bold);
}

std::vector<std::string> CodeOf(std::string_view page) {
  static const std::regex code("`([^`]+)`");
  return MatchesOf(ProseOf(page), code);
}

std::vector<std::vector<std::string>> CommandLinesOf(std::string_view page) {
  std::vector<std::vector<std::string>> all;
  for (const std::string& code : CodeOf(page)) all.push_back(WordsOf(code));
  for (const Listing& listing : ListingsOf(page)) {
    if (!listing.info.starts_with("sh")) continue;
    std::istringstream lines(listing.body);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("arthroscene ")) all.push_back(WordsOf(line));
  }
  std::erase_if(all, [](const std::vector<std::string>& words) { return words.empty(); });
  return all;
}

std::vector<std::string> LinksOf(std::string_view page) {
  static const std::regex link(R"(\]\(([^)\s]+)\))");
  std::vector<std::string> links = MatchesOf(ProseOf(page), link);
  std::erase_if(links,
                [](const std::string& target) { return target.find("://") != std::string::npos; });
  return links;
}

std::string AnchorOf(std::string_view heading) {
  std::string anchor;
  for (const char letter : heading) {
    const auto byte = static_cast<unsigned char>(letter);
    if (letter == ' ')
      anchor += '-';
    else if (std::isalnum(byte) != 0 || letter == '-' || letter == '_' || byte >= 0x80)
      anchor += static_cast<char>(std::tolower(byte));
  }
  return anchor;
}

std::vector<std::string> AnchorsOf(std::string_view page) {
  std::vector<std::string> anchors;
  std::istringstream lines{ProseOf(page)};
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("#"))
      anchors.push_back(AnchorOf(line.substr(std::min(line.find_first_not_of("# "), line.size()))));
  return anchors;
}

}  // namespace arthro::test
