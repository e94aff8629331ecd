// The jobs of the command line, one file each. Every function adds its subcommand, with the
// callback that runs it, to the program; a job that is not built yet is not listed.
#pragma once

namespace CLI {
class App;
}

namespace arthro::app {

// Adds all of the jobs below, in the order in which the help lists them.
void AddEveryJob(CLI::App& program);

void AddAdjustJob(CLI::App& program);
void AddAlignJob(CLI::App& program);
// Lists `bench` in the help. RunBenchProgram runs it.
void AddAssessJob(CLI::App& program);
void AddBenchJob(CLI::App& program);
inline constexpr const char* kBenchProgram = "arthroscene-bench";  // beside this program's file
// Replaces this process with kBenchProgram; `arguments` end with a null pointer. Returns the exit
// status only where that fails.
int RunBenchProgram(char** arguments);
void AddCentresJob(CLI::App& program);
void AddReachJob(CLI::App& program);
void AddCheckJob(CLI::App& program);
void AddDemoJob(CLI::App& program);
void AddDepthJob(CLI::App& program);
void AddDevicesJob(CLI::App& program);
void AddEditJob(CLI::App& program);  // runs without a job as well
void AddHelpJob(CLI::App& program);
void AddLensJob(CLI::App& program);
void AddModelJob(CLI::App& program);
void AddPanoramaJob(CLI::App& program);
void AddPhantomJob(CLI::App& program);
void AddPivotJob(CLI::App& program);
void AddPractiseJob(CLI::App& program);
void AddRecordsJob(CLI::App& program);
void AddRectifyJob(CLI::App& program);
void AddReliefJob(CLI::App& program);
void AddReplayJob(CLI::App& program);
void AddRobotJob(CLI::App& program);
void AddRunJob(CLI::App& program);
void AddSolveJob(CLI::App& program);
void AddTetrahedralizeJob(CLI::App& program);
void AddViewJob(CLI::App& program);

}  // namespace arthro::app
