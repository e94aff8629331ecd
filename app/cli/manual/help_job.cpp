// help: where the manual lies, or one of its pages as text.
#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "app/cli/jobs.h"
#include "app/help/help_pages.h"
#ifdef ARTHRO_EDITOR
#include "app/platform/own_display.h"
#endif

namespace arthro::app {
namespace {

void PrintContents() {
  for (const HelpPage& page : HelpPages())
    std::printf("%-16s %s\n", page.name.c_str(), page.title.c_str());
  std::printf("\n`arthroscene help PAGE` prints a page. %s\n", WhereTheManualIs().c_str());
#ifdef ARTHRO_EDITOR
  if (const auto index = HelpInHtml("index"); index && HasDisplay() && !OpenOnDesktop(*index))
    std::printf("It is not opened: xdg-open is not on this machine.\n");
#endif
}

}  // namespace

void AddHelpJob(CLI::App& program) {
  const auto page = std::make_shared<std::string>();
  CLI::App* job = program.add_subcommand(
      "help", "Open the manual, or print one of its pages; without a display say where it lies.");
  job->add_option("PAGE", *page, "Page of the manual, such as educator or troubleshooting.");
  job->callback([page] {
    if (page->empty()) return PrintContents();
    const std::string text = HelpText(*page);
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::string linked;
    for (const std::string& name : PagesLinkedFrom(*page, text))
      linked += (linked.empty() ? "" : ", ") + name;
    if (!linked.empty())
      std::printf("\nPages that it links, for `arthroscene help`: %s\n", linked.c_str());
  });
}

}  // namespace arthro::app
