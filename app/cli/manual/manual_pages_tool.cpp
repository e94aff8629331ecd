// arthroscene-manual-pages FOLDER: writes the manual pages, the completion of bash and the manual's
// page of keys there.
#include <cstdio>
#include <exception>
#include <filesystem>

#include <CLI/CLI.hpp>

#include "app/about/about.h"
#include "app/cli/command_line.h"
#ifdef ARTHRO_EDITOR
#include "app/cli/manual/keys_page.h"
#endif
#include "app/cli/manual/manual_pages.h"
#include "simulation/core/atomic_file.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: arthroscene-manual-pages FOLDER\n");
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    CLI::App program;
    arthro::app::DescribeProgram(program);
    for (const auto& [name, text] : arthro::app::ManualPages(program, arthro::app::Version()))
      arthro::WriteAtomically(folder / name, text);
#ifdef ARTHRO_EDITOR
    arthro::WriteAtomically(folder / "keys.md", arthro::app::KeysPage());
#endif
    arthro::WriteAtomically(folder / "arthroscene.bash", arthro::app::BashCompletion(program));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "arthroscene-manual-pages: %s\n", error.what());
    return 1;
  }
  return 0;
}
