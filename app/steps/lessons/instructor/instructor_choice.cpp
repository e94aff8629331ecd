#include "app/steps/lessons/instructor/instructor_choice.h"

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/option_fields.h"

namespace arthro::app {
namespace {

constexpr const char* kFile = "instructor.json";

}  // namespace

InstructorChoice ReadInstructorChoice(const std::filesystem::path& folder) {
  std::error_code ignored;
  const auto file = folder / kFile;
  if (!std::filesystem::exists(file, ignored)) return {};
  try {
    InstructorChoice choice;
    ReadOptionsText(ReadWholeFile(file, kMostJsonBytes), file, choice);
    return choice;
  } catch (const std::exception&) {
    return {};
  }
}

void WriteInstructorChoice(const std::filesystem::path& folder, const InstructorChoice& choice) {
  try {
    WriteAtomically(folder / kFile, OptionsText(choice, 2) + "\n", Access::kPrivate);
  } catch (const std::exception&) {
    // The next start has the defaults.
  }
}

}  // namespace arthro::app
