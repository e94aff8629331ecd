// Reads every bracketed citation in the sources and every link and path in the documents, and fails
// when its target does not exist. Targets are headings of resources/doc/*.md, rows of
// references.md, sections of the publication, and labels of hard-cases.md.
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/documents/source_text.h"
#include "tests/support/build_paths.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = ARTHRO_SOURCE_DIR;
const fs::path kDocuments = kRoot / "resources/doc";

struct Targets {
  std::set<std::string> headings;  // "method.md, Oblique view"
  std::set<std::string> works;     // "Hartley 1997"
  std::set<std::string> labels;    // "PAN-01"
};

// The first cell of every row of a table. Formatting is left as it is.
std::set<std::string> FirstCells(const std::string& text) {
  std::set<std::string> cells;
  std::istringstream lines(text);
  const std::regex row(R"(^\| ([^|]+?) \|)");
  std::smatch match;
  for (std::string line; std::getline(lines, line);)
    if (std::regex_search(line, match, row)) cells.insert(match[1]);
  return cells;
}

Targets TargetsOf(const fs::path& documents) {
  Targets targets;
  for (const auto& entry : fs::directory_iterator(documents)) {
    if (!entry.is_regular_file()) continue;
    std::istringstream lines(TextOf(entry.path()));
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("## "))
        targets.headings.insert(entry.path().filename().string() + ", " + line.substr(3));
  }
  targets.works = FirstCells(TextOf(documents / "references.md"));
  targets.labels = FirstCells(TextOf(documents / "hard-cases.md"));
  return targets;
}

// The citations within one comment: every part between brackets and semicolons that begins with the
// name of a document, with "paper", or with an author and a year.
std::vector<std::string> CitationsOf(const std::string& comment) {
  static const std::regex bracket(R"(\[([^\]\[]+)\])");
  static const std::regex form(
      R"(^(paper\b|design\b|notes?\b|[a-z-]+\.md\b|[A-Z][^,;]*( & | et al\.|, )?.*\b(1[89]|20)\d\d\b))");
  std::vector<std::string> citations;
  for (std::sregex_iterator found(comment.begin(), comment.end(), bracket), end; found != end;
       ++found) {
    std::istringstream parts((*found)[1].str());
    for (std::string part; std::getline(parts, part, ';');) {
      part.erase(0, part.find_first_not_of(' '));
      if (std::regex_search(part, form)) citations.push_back(part);
    }
  }
  return citations;
}

bool Exists(const std::string& citation, const Targets& targets) {
  static const std::regex paper(R"(^paper, 3\.[1-4](, 3\.[1-4])*(, Fig\. 7)?$)");
  static const std::regex work(R"(^(.*?\b(1[89]|20)\d\d)\b)");
  if (std::regex_search(citation, paper)) return true;
  if (targets.headings.contains(citation)) return true;
  std::smatch match;
  return std::regex_search(citation, match, work) && targets.works.contains(match[1]);
}

std::vector<std::string> FaultsOf(const std::string& source, const Targets& targets) {
  static const std::regex label(R"(\b(PAN|LENS|RELIEF|FEM|HAP|VIEW|FILE)-\d+\b)");
  static const std::regex retired(R"((design §|[Hh]ard case \d|notes on (haptics|deform)))");
  std::vector<std::string> faults;
  for (const Comment& lines : PartsOfSource(source).comments) {
    const std::string comment = lines.Joined();
    for (const std::string& citation : CitationsOf(comment))
      if (!Exists(citation, targets)) faults.push_back("[" + citation + "]");
    for (std::sregex_iterator found(comment.begin(), comment.end(), label), end; found != end;
         ++found)
      if (!targets.labels.contains(found->str())) faults.push_back(found->str());
    std::smatch match;
    if (std::regex_search(comment, match, retired)) faults.push_back(match.str() + "…");
  }
  return faults;
}

TEST(Citations, EachTargetExists) {
  const Targets targets = TargetsOf(kDocuments);
  std::size_t count = 0;
  for (const fs::path& file : SourceFiles(kRoot)) {
    const std::string source = TextOf(file);
    for (const Comment& comment : PartsOfSource(source).comments)
      count += CitationsOf(comment.Joined()).size();
    for (const std::string& fault : FaultsOf(source, targets))
      ADD_FAILURE() << fs::relative(file, kRoot).string() << ": " << fault
                    << " has no target in resources/doc";
  }
  EXPECT_GT(count, 80u) << "the scan found too few citations to mean anything";
}

TEST(Citations, ScanCatchesDanglingOnes) {
  const Targets targets = TargetsOf(kDocuments);
  EXPECT_EQ(
      FaultsOf("// a [method.md, Oblique view]\n// b [Hartley 1997, eq. 3; paper, 3.1]\n", targets),
      std::vector<std::string>{});
  for (const char* dangling :
       {"// [method.md, No such heading]", "// [Nobody 1999]", "// [paper 3.4]", "// [design §4]",
        "// see PAN-77", "// Hard case 13.", "// [notes on\n// haptics, 3]", "// [paper, 3.9]"})
    EXPECT_EQ(FaultsOf(dangling, targets).empty(), false) << dangling;
}

// "a/{b,c}" stands for "a/b" and "a/c".
std::vector<std::string> Expanded(const std::string& text) {
  const std::size_t open = text.find('{'), close = text.find('}');
  if (open == std::string::npos || close == std::string::npos) return {text};
  std::vector<std::string> all;
  std::istringstream words(text.substr(open + 1, close - open - 1));
  for (std::string word; std::getline(words, word, ',');)
    for (const std::string& path : Expanded(text.substr(0, open) + word + text.substr(close + 1)))
      all.push_back(path);
  return all;
}

TEST(Documents, NamedPathsExist) {
  const std::regex path(
      R"(`((\.ci|app|authoring|simulation|resources|tests|packaging)/[^`\s*<]*)`)");
  for (const fs::path& page : DocumentFiles(kRoot)) {
    const std::string text = TextOf(page);
    for (std::sregex_iterator found(text.begin(), text.end(), path), end; found != end; ++found)
      for (const std::string& name : Expanded((*found)[1]))
        EXPECT_TRUE(fs::exists(kRoot / name)) << page.filename() << " names " << name;
  }
}

// safety.md names the test of each limit as `Suite.Name`, and links the file that holds it.
TEST(Documents, TestsThatTheSafetyPageNamesExist) {
  std::string sources;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests"))
    if (entry.path().extension() == ".cpp") sources += TextOf(entry.path());
  const std::string page = TextOf(kDocuments / "safety.md");
  const std::regex name(R"(`([A-Za-z]+)\.([A-Z]\w+)`)");
  int count = 0;
  for (std::sregex_iterator found(page.begin(), page.end(), name), end; found != end;
       ++found, ++count) {
    const std::string test = "(" + (*found)[1].str() + ", " + (*found)[2].str() + ")";
    EXPECT_NE(sources.find(test), std::string::npos) << "safety.md names " << found->str();
  }
  const std::regex linked(R"(\[`(\w+)\.(\w+)`\]\(\.\./\.\./([^)]+)\))");
  int links = 0;
  for (std::sregex_iterator found(page.begin(), page.end(), linked), end; found != end;
       ++found, ++links)
    EXPECT_NE(TextOf(kRoot / (*found)[3].str())
                  .find("(" + (*found)[1].str() + ", " + (*found)[2].str() + ")"),
              std::string::npos)
        << (*found)[3] << " does not hold " << (*found)[1] << "." << (*found)[2];
  EXPECT_EQ(links, count) << "a test of safety.md has no link to its file";
  EXPECT_GT(count, 25) << "the scan found too few names to mean anything";
}

TEST(Documents, RelativeLinksResolve) {
  const std::regex link(R"(\]\(([^)#:]+)(#[^)]*)?\))");
  for (const fs::path& page : DocumentFiles(kRoot)) {
    const std::string text = TextOf(page);
    for (std::sregex_iterator found(text.begin(), text.end(), link), end; found != end; ++found)
      EXPECT_TRUE(fs::exists(page.parent_path() / (*found)[1].str()))
          << page.filename() << " links " << (*found)[1];
  }
}

}  // namespace
}  // namespace arthro::test
