// The jobs of the command line, one file each. Every function adds its subcommand, with the
// callback that runs it, to the program; a job that is not built yet is not listed.
#pragma once

namespace CLI {
class App;
}

namespace arthro::app {

// All of the jobs below, in the order in which the help lists them. Wrong use is said in one line.
void AddEveryJob(CLI::App& program);

void AddBenchJob(CLI::App& program);
void AddCentresJob(CLI::App& program);
void AddCheckJob(CLI::App& program);
void AddDemoJob(CLI::App& program);
void AddDepthJob(CLI::App& program);
void AddDevicesJob(CLI::App& program);
void AddEditJob(CLI::App& program);
void AddLensJob(CLI::App& program);
void AddPanoramaJob(CLI::App& program);
void AddPhantomJob(CLI::App& program);
void AddPivotJob(CLI::App& program);
void AddPractiseJob(CLI::App& program);
void AddRectifyJob(CLI::App& program);
void AddReliefJob(CLI::App& program);
void AddReplayJob(CLI::App& program);
void AddSolveJob(CLI::App& program);
void AddTetrahedralizeJob(CLI::App& program);
void AddViewJob(CLI::App& program);

}  // namespace arthro::app
