#include <algorithm>
#include <string>

#include <CLI/CLI.hpp>

#include "app/cli/jobs.h"

namespace arthro::app {
namespace {

// Wrong use in one line, whatever was typed.
std::string UsageLine(const CLI::App*, const CLI::Error& error) {
  std::string sentence = error.what();
  std::replace_if(
      sentence.begin(), sentence.end(),
      [](unsigned char letter) { return letter < 0x20 || letter == 0x7f; }, ' ');
  return "arthroscene: " + sentence + "; `arthroscene JOB --help` says what a job takes\n";
}

}  // namespace

void AddEveryJob(CLI::App& program) {
  program.failure_message(UsageLine);
  AddBenchJob(program);
  AddCentresJob(program);
  AddCheckJob(program);
  AddDemoJob(program);
  AddDepthJob(program);
  AddDevicesJob(program);
  AddEditJob(program);
  AddLensJob(program);
  AddPanoramaJob(program);
  AddPhantomJob(program);
  AddPivotJob(program);
  AddPractiseJob(program);
  AddRectifyJob(program);
  AddReliefJob(program);
  AddReplayJob(program);
  AddSolveJob(program);
  AddTetrahedralizeJob(program);
  AddViewJob(program);
}

}  // namespace arthro::app
