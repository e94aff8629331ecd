#include "app/cli/practice/lesson_flags.h"

#include <cstdio>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/editor/editor.h"
#include "app/editor/editor_settings.h"
#include "app/records/people/trainees.h"
#include "simulation/core/error.h"
#include "simulation/scene/exercise/find_exercise.h"
#include "simulation/scene/files/scene_io.h"

namespace arthro::app {
namespace {

constexpr double kPatience = 2;  // s for a locked file or a silent server, before the window opens

bool KnowsTrainee(const std::string& place, EditorOptions& options) {
  const std::string& code = options.lesson->trainee;
  std::error_code ignored;
  if (!IsServer(place) && !std::filesystem::exists(place, ignored)) return false;
  RecordsOptions records_options;
  records_options.timeout = kPatience;
  try {
    Records records(place, records_options);
    return KnowsTrainee(records, code);
  } catch (const Error& fault) {
    options.notice = fmt::format("The attempts of {} go to the outbox: {}", code, fault.what());
    std::fprintf(stderr, "warning: %s\n", options.notice.c_str());
    return true;
  }
}

}  // namespace

void AddLessonFlags(CLI::App& job, EditorOptions& options) {
  CLI::Option* exercise = job.add_option_function<std::string>(
                                 "--exercise",
                                 [&options](const std::string& id) {
                                   if (!options.lesson) options.lesson.emplace();
                                   options.lesson->exercise = id;
                                 },
                                 "Exercise of the scene to open the window on.")
                              ->type_name("ID");
  CLI::Option* trainee = job.add_option_function<std::string>(
                                "--trainee",
                                [&options](const std::string& code) {
                                  if (!options.lesson) options.lesson.emplace();
                                  options.lesson->trainee = code;
                                },
                                "Code of the trainee whose attempts are kept; without it none is.")
                             ->type_name("CODE");
  trainee->needs(exercise);
  job.add_flag_callback(
         "--test",
         [&options] {
           if (!options.lesson) options.lesson.emplace();
           options.lesson->is_test = true;
         },
         "Begin in mode test, which counts for the gate of the exercise.")
      ->needs(trainee);
}

void CheckLesson(EditorOptions& options) {
  if (!options.lesson) return;
  ExerciseWithId(ReadScene(*options.scene).exercises, options.lesson->exercise);
  const std::string& code = options.lesson->trainee;
  if (code.empty()) return;
  CheckTraineeCode(code);
  const std::optional<std::string> given = RecordsFor(options);
  const std::string place = given ? *given : DefaultRecords();
  if (place.empty() || KnowsTrainee(place, options)) return;
  throw Error(Code::kBadArgument,
              fmt::format("no trainee has the code {0}; add it with `arthroscene records trainee "
                          "add {0}{1}`, or check its spelling",
                          code, options.records ? " --records " + *options.records : ""));
}

}  // namespace arthro::app
