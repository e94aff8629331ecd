// Trainees under pseudonyms. The program never stores a name: names beside codes stay in a file of
// the instructor [GDPR, article 4(5)].
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/records/attempts/attempt_record.h"
#include "app/records/store/records.h"

namespace arthro::app {

// Throws Error(kBadArgument) for a text that cannot be a code.
void CheckTraineeCode(const std::string& code);
// `trainee` without id and time, which it gets; its `cohort` is a name, made where it is new.
// Throws Error where the code is taken or no code.
TraineeRow AddTrainee(Records& records, TraineeRow trainee);
// A new code that nobody has, such as T-7F3K.
std::string FreeCode(Records& records);
bool KnowsTrainee(Records& records, const std::string& code);
std::vector<TraineeRow> TraineesOf(Records& records);
std::vector<CohortRow> CohortsOf(Records& records);
TraineeRow FindTrainee(Records& records, const std::string& code);  // throws Error
void RenameTrainee(Records& records, const std::string& code, const std::string& new_code,
                   const std::string& who);

// An instructor's opening of an exercise for a trainee; the audit keeps it with its reason.
struct GateRow {
  std::string trainee, exercise, opened, by_whom;
  template <class V>
  void Visit(V&& v) {
    v("trainee", trainee, Required{Any{}}, "", "UUID of the trainee.");
    v("exercise", exercise, Required{Any{}}, "", "Hash of the exercise.");
    v("opened", opened, Required{Any{}}, "", "Time in UTC.");
    v("by_whom", by_whom, Any{}, "", "Code of the instructor.");
  }
};
void OpenGate(Records& records, const std::string& trainee_code, const std::string& exercise_hash,
              const std::string& who, const std::string& reason);
// The same for an exercise that nobody may have tried yet.
void OpenGate(Records& records, const std::string& trainee_code, const ExerciseRow& exercise,
              const std::string& who, const std::string& reason);
std::vector<GateRow> GatesOf(Records& records, const std::string& trainee_code);

struct Erased {
  long attempts = 0, forms = 0, files = 0;
  std::vector<std::string> groups;     // reference groups that were computed again
  std::vector<std::string> elsewhere;  // files of other stations: "STATION: FILE"
};
// Removes a trainee with all rows and files, and computes the reference groups again. The audit
// keeps a hash in place of the code. Backups keep the trainee until they are deleted.
Erased EraseTrainee(Records& records, const std::string& code, const std::string& who);

}  // namespace arthro::app
