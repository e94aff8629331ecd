// The manual names nothing that does not exist, and leaves no job, key, step or format out.
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "app/cli/command_line.h"
#include "app/cli/manual/keys_page.h"
#include "app/editor/every_step.h"
#include "app/editor/help/key_list.h"
#include "app/panels/options_panel.h"
#include "app/platform/script/script.h"
#include "tests/documents/manual/manual_text.h"
#include "tests/documents/source_text.h"
#include "tests/documents/window_words.h"
#include "tests/support/build_paths.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;
using namespace test;

const fs::path kRoot = ARTHRO_SOURCE_DIR;
const fs::path kManual = kRoot / "resources/doc/manual";

const std::vector<ManualText>& Pages() {
  static const std::vector<ManualText> pages = ManualTexts(kRoot);
  return pages;
}

std::string PageText(const std::string& name) { return TextOf(kManual / (name + ".md")); }

// ---- Links ----

TEST(Manual, EveryPageIsReachedFromTheIndex) {
  std::set<std::string> reached = {"index.md"};
  std::vector<std::string> open = {"index.md"};
  while (!open.empty()) {
    const std::string text = TextOf(kManual / open.back());
    open.pop_back();
    for (const std::string& link : LinksOf(text)) {
      const std::string page = link.substr(0, link.find('#'));
      if (page.ends_with(".md") && page.find('/') == std::string::npos &&
          reached.insert(page).second)
        open.push_back(page);
    }
  }
  for (const ManualText& page : Pages())
    EXPECT_TRUE(reached.contains(page.name + ".md")) << page.name;
  EXPECT_GT(Pages().size(), 12u);
}

TEST(Manual, EveryAnchorOfALinkIsAHeading) {
  for (const ManualText& page : Pages())
    for (const std::string& link : LinksOf(page.text)) {
      const std::size_t mark = link.find('#');
      if (mark == std::string::npos) continue;
      const fs::path file =
          mark == 0 ? kManual / (page.name + ".md") : kManual / link.substr(0, mark);
      const auto anchors = AnchorsOf(TextOf(file));
      EXPECT_NE(std::find(anchors.begin(), anchors.end(), link.substr(mark + 1)), anchors.end())
          << page.name << ".md links " << link;
    }
}

// ---- Names of the window ----

// Names and choices of the fields in every list of options, as the window writes them.
std::set<std::string> FieldLabels() {
  static const std::regex field(R"re(\bv\("([a-z_]+)",)re");
  static const std::regex choice(R"re(::k\w+, "([^"]+)"\})re");
  std::set<std::string> labels;
  for (const fs::path& file : SourceFiles(kRoot)) {
    if (file.extension() != ".h") continue;
    const std::string text = TextOf(file);
    for (std::sregex_iterator found(text.begin(), text.end(), field), none; found != none; ++found)
      labels.insert(app::LabelOfField((*found)[1].str()));
    for (std::sregex_iterator found(text.begin(), text.end(), choice), none; found != none; ++found)
      labels.insert((*found)[1]);
  }
  for (const auto& [name, word] : app::LabelledChoices())
    labels.insert(app::LabelOfChoice(name, word));
  return labels;
}

// Everything that is written on a control. The German table has an entry for each (window_words).
const std::set<std::string>& Labels() {
  static const std::set<std::string> labels = [] {
    std::set<std::string> all = FieldLabels();
    for (const WindowWord& word : WindowWords(kRoot)) all.insert(word.text);
    for (const app::Command& command : app::AllCommands()) all.insert(command.words);
    return all;
  }();
  return labels;
}

std::vector<std::string> UnknownLabels(const std::string& page) {
  std::vector<std::string> unknown;
  for (const std::string& bold : BoldOf(page))
    if (!Labels().contains(bold)) unknown.push_back(bold);
  return unknown;
}

TEST(Manual, NamesOnlyLabelsOfTheWindow) {
  std::size_t count = 0;
  for (const ManualText& page : Pages()) {
    count += BoldOf(page.text).size();
    for (const std::string& label : UnknownLabels(page.text))
      ADD_FAILURE() << page.name << ".md: no control bears \"" << label << '"';
  }
  EXPECT_GT(count, 300u);
  EXPECT_EQ(UnknownLabels("Press **Save**, then **Sauve**."), std::vector<std::string>{"Sauve"});
}

TEST(Manual, HasAPageForEveryStep) {
  for (const app::Command& command : app::AllCommands()) {
    if (std::string(command.group) != "Steps") continue;
    EXPECT_TRUE(fs::exists(kManual / (AnchorOf(command.words) + ".md"))) << command.words;
  }
}

// ---- Keys ----

TEST(Manual, PageOfKeysIsThatOfTheProgram) {
  EXPECT_EQ(PageText("keys"), app::KeysPage())
      << "build/release/bin/arthroscene-manual-pages FOLDER writes FOLDER/keys.md anew";
}

std::set<std::string> KnownKeys() {
  static const std::regex between(" or |, ");
  std::set<std::string> keys = {"Ctrl", "Shift"};
  for (const app::KeyGroup& group : app::KeyGroups(app::AllCommands()))
    for (const app::KeyRow& row : group.rows) {
      keys.insert(row.keys);
      for (std::sregex_token_iterator part(row.keys.begin(), row.keys.end(), between, -1), none;
           part != none; ++part)
        keys.insert(*part);
    }
  return keys;
}

TEST(Manual, NamesOnlyKeysOfTheWindow) {
  static const std::regex key(
      R"((Ctrl\+|Shift\+)*([A-Z0-9?\[\]]|F[0-9]+|Escape|Space|Home|Delete))");
  const std::set<std::string> known = KnownKeys();
  EXPECT_TRUE(known.contains("Ctrl+S"));
  EXPECT_FALSE(known.contains("Ctrl+J"));
  for (const ManualText& page : Pages())
    for (const std::string& code : CodeOf(page.text))
      EXPECT_TRUE(!std::regex_match(code, key) || known.contains(code))
          << page.name << ".md: no key " << code;
}

// ---- Jobs, flags and commands ----

class ManualOfJobs : public ::testing::Test {
 protected:
  ManualOfJobs() { app::DescribeProgram(program_); }

  static bool HasFlag(const CLI::App& job, const std::string& flag) {
    if (flag == "--help" || flag == "--version") return true;
    for (const CLI::Option* option : job.get_options())
      if (option->check_lname(flag.substr(2))) return true;
    return false;
  }
  bool AnyHasFlag(const std::string& flag) const {
    if (HasFlag(program_, flag)) return true;
    for (const CLI::App* job : program_.get_subcommands({})) {
      if (HasFlag(*job, flag)) return true;
      for (const CLI::App* part : job->get_subcommands({}))
        if (HasFlag(*part, flag)) return true;
    }
    return false;
  }
  static const CLI::App* Named(const CLI::App& app, const std::string& name) {
    for (const CLI::App* job : app.get_subcommands({}))
      if (job->check_name(name)) return job;
    return nullptr;
  }

  // Job, flag or page of a command line that the program does not have; empty: all are there.
  std::string FaultOf(const std::vector<std::string>& words) const {
    const bool is_call = words[0] == "arthroscene";
    std::size_t next = is_call ? 1 : 0;
    if (next == words.size()) return "";
    const CLI::App* job = Named(program_, words[next]);
    if (job == nullptr && is_call && words[next] != "JOB" && !words[next].starts_with("--"))
      return "there is no job " + words[next];
    const bool is_other = !is_call && job == nullptr && !words[0].starts_with("--");
    if (is_other) return "";                                  // a key, a file or a word
    if (job != nullptr && words[next] == "bench") return "";  // a program of its own
    if (job != nullptr && words[next] == "help" && next + 1 < words.size()) {
      const std::string& page = words[next + 1];
      const bool is_there = fs::exists(kManual / (page + ".md")) ||
                            fs::exists(kManual.parent_path() / (page + ".md"));
      return page == "PAGE" || is_there ? "" : "no page " + page;
    }
    for (std::size_t i = next; i < words.size(); ++i) {
      if (job != nullptr)
        if (const CLI::App* part = Named(*job, words[i])) job = part;
      const std::string flag = words[i].substr(0, words[i].find('='));
      if (!flag.starts_with("--")) continue;
      if (job != nullptr ? !HasFlag(*job, flag) : !AnyHasFlag(flag))
        return (job != nullptr ? job->get_name() : "no job") + " has " + flag;
    }
    return "";
  }

  CLI::App program_;
};

TEST_F(ManualOfJobs, NamesOnlyJobsAndFlagsThatExist) {
  std::size_t count = 0;
  std::vector<ManualText> pages = Pages();
  pages.push_back({"../jobs", TextOf(kRoot / "resources/doc/jobs.md")});
  for (const ManualText& page : pages)
    for (const auto& words : CommandLinesOf(page.text)) {
      count += words[0] == "arthroscene" ? 1 : 0;
      const std::string fault = FaultOf(words);
      EXPECT_EQ(fault, "") << page.name << ".md";
    }
  EXPECT_GT(count, 40u);
  EXPECT_NE(FaultOf({"arthroscene", "depht"}), "");
  EXPECT_NE(FaultOf({"arthroscene", "depth", "--estimater", "shading"}), "");
  EXPECT_NE(FaultOf({"practise", "SCENE", "--zero"}), "");
  EXPECT_NE(FaultOf({"arthroscene", "help", "dept"}), "");
}

TEST_F(ManualOfJobs, EveryJobIsListed) {
  const std::string page = TextOf(kRoot / "resources/doc/jobs.md");
  for (const CLI::App* job : program_.get_subcommands({})) {
    if (job->get_group().empty()) continue;  // hidden
    EXPECT_TRUE(std::regex_search(page, std::regex("\n\\|[^|]*`" + job->get_name() + "`")))
        << "jobs.md has no row for " << job->get_name();
  }
}

std::set<std::string> CommandNames() {
  std::set<std::string> ids;
  for (const app::Command& command : app::AllCommands()) ids.insert(command.id);
  return ids;
}

TEST(Manual, NamesOnlyCommandsOfTheWindow) {
  const std::set<std::string> ids = CommandNames();
  static const std::regex line("(^|\n)do ([a-z0-9-]+)");
  for (const ManualText& page : Pages())
    for (const Listing& listing : ListingsOf(page.text))
      for (std::sregex_iterator found(listing.body.begin(), listing.body.end(), line), none;
           found != none; ++found)
        EXPECT_TRUE(ids.contains((*found)[2])) << page.name << ".md: do " << (*found)[2];
}

// ---- File formats ----

TEST(Manual, EveryFileFormatIsListed) {
  const std::string page = PageText("formats");
  for (const auto& entry : fs::directory_iterator(kRoot / "resources/schemas")) {
    if (entry.path().extension() != ".json") continue;
    EXPECT_NE(page.find("/" + entry.path().filename().string()), std::string::npos)
        << "formats.md does not link " << entry.path().filename();
  }
  // method.md describes each format in a paragraph that begins with its name.
  const std::string method = TextOf(kRoot / "resources/doc/method.md");
  static const std::regex name(R"(\n\*\*([^*]+)\*\*)");
  std::size_t count = 0;
  for (std::sregex_iterator found(method.begin(), method.end(), name), none; found != none;
       ++found, ++count)
    EXPECT_NE(page.find((*found)[1]), std::string::npos)
        << "formats.md does not name " << (*found)[1];
  EXPECT_GT(count, 15u);
}

// ---- Pictures ----

TEST(Manual, EveryPictureIsShownMadeByAScriptAndSmall) {
  std::string shown, made;
  for (const ManualText& page : Pages()) shown += page.text;
  std::uintmax_t bytes = 0;
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(kManual / "pictures"))
    if (entry.path().extension() == ".script") made += TextOf(entry.path());
  for (const auto& entry : fs::directory_iterator(kManual / "pictures")) {
    if (entry.path().extension() == ".script") continue;
    const std::string name = entry.path().filename().string(), stem = entry.path().stem().string();
    EXPECT_EQ(entry.path().extension(), ".jpg") << name;
    EXPECT_NE(shown.find("](pictures/" + name + ")"), std::string::npos) << name;
    EXPECT_NE(made.find("\nshot " + stem + ".png\n"), std::string::npos) << name;
    EXPECT_LE(entry.file_size(), 100'000u) << name;
    bytes += entry.file_size();
    ++count;
  }
  EXPECT_LE(bytes, 2'000'000u);
  EXPECT_GT(count, 10u);
}

// A script names commands, labels, and parts of the demo scene.
TEST(Manual, ScriptsOfPicturesNameOnlyWhatIsThere) {
  std::set<std::string> known = CommandNames();
  known.insert({"Picture", "Overview", "Depth map"});
  const std::string demo = TextOf(kRoot / "resources/demo/scene.json");
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(kManual / "pictures")) {
    if (entry.path().extension() != ".script") continue;
    for (const app::ScriptLine& line : app::ParseScript(TextOf(entry.path()), entry.path())) {
      const std::string name = line.name.substr(0, line.name.find("##"));
      count += name.empty() ? 0 : 1;
      EXPECT_TRUE(name.empty() || known.contains(name) || Labels().contains(name) ||
                  demo.find("\"" + name + "\"") != std::string::npos)
          << entry.path().filename() << " line " << line.number << ": " << name;
    }
  }
  EXPECT_GT(count, 30u);
}

}  // namespace
}  // namespace arthro
