// Manual pages and the completion of the shell, made from the same list of options as `--help`, so
// that they name nothing that does not exist.
#pragma once

#include <map>
#include <string>

namespace CLI {
class App;
}

namespace arthro::app {

// Text in roff by file name: arthroscene.1, and arthroscene-JOB.1 for each job.
std::map<std::string, std::string> ManualPages(const CLI::App& program, const std::string& version);

// Script for bash that completes jobs and their flags, and files elsewhere.
std::string BashCompletion(const CLI::App& program);

}  // namespace arthro::app
