#include <CLI/CLI.hpp>

#include "app/cli/jobs.h"

namespace arthro::app {

void AddEveryJob(CLI::App& program) {
  AddAdjustJob(program);
  AddAlignJob(program);
  AddAssessJob(program);
  AddBenchJob(program);
  AddCentresJob(program);
  AddReachJob(program);
  AddCheckJob(program);
  AddDemoJob(program);
  AddDepthJob(program);
  AddDevicesJob(program);
#ifdef ARTHRO_EDITOR
  AddEditJob(program);
#endif
  AddHelpJob(program);
  AddLensJob(program);
  AddModelJob(program);
  AddPanoramaJob(program);
  AddPhantomJob(program);
  AddPivotJob(program);
#ifdef ARTHRO_EDITOR
  AddPractiseJob(program);
#endif
  AddRecordsJob(program);
  AddRectifyJob(program);
  AddReliefJob(program);
  AddReplayJob(program);
  AddRobotJob(program);
#ifdef ARTHRO_EDITOR
  AddRunJob(program);
#endif
  AddSolveJob(program);
  AddTetrahedralizeJob(program);
  AddViewJob(program);
}

}  // namespace arthro::app
