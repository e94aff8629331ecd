// Attempts in the records: a row is written when an attempt begins, its results in one transaction
// when it ends. What was found running and whose program is gone was cut short.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/records/attempts/attempt_record.h"
#include "app/records/store/records.h"
#include "simulation/training/attempt_result.h"

namespace arthro::app {

// Results as rows, and rows as a result. Metrics and kinds of events that this program does not
// know are left out of a result.
void SetResult(AttemptRecord& record, const simulation::AttemptResult& result);
simulation::AttemptResult ResultOf(const AttemptRecord& record);

// A session of a trainee at this station. The trainee must be known (people/trainees.h).
SessionRow StartSession(Records& records, const std::string& trainee_code,
                        const std::string& program, const std::string& rig);
void EndSession(Records& records, const std::string& session);

// Held while an attempt runs, and made with the folder of its log: the system gives it back when
// the process ends, however it ends, and so tells an attempt that runs from one that was cut short.
class AttemptMark {
 public:
  AttemptMark() = default;
  AttemptMark(const std::filesystem::path& folder, const std::string& attempt);
  ~AttemptMark();  // removes the mark
  AttemptMark(AttemptMark&& other) noexcept;
  AttemptMark& operator=(AttemptMark&& other) noexcept;
  bool is_held() const { return lock_ >= 0; }
  // Gives the mark back without removing it: the attempt is recovered at the next start.
  void Leave();

 private:
  std::filesystem::path file_;
  int lock_ = -1;
};

// An attempt whose row is written; its mark is held.
struct StartedAttempt {
  AttemptRecord record;
  AttemptMark mark;
};

// Writes the row `running`. The begin of an attempt never lies before that of the trainee's last
// one, even where the clock was set back: then it follows that one by 1 ms, and the audit says so.
StartedAttempt StartAttempt(Records& records, const SessionRow& session,
                            const ExerciseRow& exercise, const std::string& scene, AttemptMode mode,
                            int metrics_version);

// Files of an attempt below the folder of the records: its log, and the mark while it runs.
std::string LogNameOf(const std::string& attempt);
std::string MarkNameOf(const std::string& attempt);

// Writes an attempt that is over, with all that it refers to; a trainee is known by the code. Takes
// the place of its row `running`. Returns false, and changes nothing, for one that is there
// already.
bool PutAttempt(Records& records, const RecordsBundle& bundle, const AttemptRecord& attempt);

// Writes the result of an attempt that StartAttempt began.
bool FinishAttempt(Records& records, const AttemptRecord& record);

std::optional<AttemptRecord> ReadAttempt(Records& records, const std::string& id);
// Attempts without steps, metrics, criteria and events, oldest first. Empty texts stand for any.
std::vector<AttemptRecord> AttemptsOf(Records& records, const std::string& trainee_code,
                                      const std::string& exercise_hash = "");

// The newest version of an exercise in the records. Throws Error where there is none.
ExerciseRow FindExercise(Records& records, const std::string& id);

// Checksum and size of the attempt's log, where it can be read.
void SetLogSum(const std::filesystem::path& folder, AttemptRecord& record);

// Attempts of this station and folder that were cut short become `stopped`, with what `assess`
// finds in their logs; nothing from it means that the log could not be read. Returns a sentence for
// each.
using AssessLog =
    std::function<std::optional<simulation::AttemptResult>(const AttemptRecord& record)>;
std::vector<std::string> RecoverAttempts(Records& records, const AssessLog& assess);

}  // namespace arthro::app
