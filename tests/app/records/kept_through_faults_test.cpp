// Faults of the records before and during an attempt: each is one sentence, the attempt is kept,
// and once the fault is gone it is in the records exactly once, with its log.
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "app/records/attempts/outbox.h"
#include "app/records/attempts/records_file.h"
#include "app/records/keeping/kept_attempt.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/sample_attempts.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

// Another process that holds the database for itself until this is destroyed.
class LockOfAnother {
 public:
  explicit LockOfAnother(const std::string& place) {
    int ready[2] = {}, end[2] = {};
    if (::pipe(ready) != 0 || ::pipe(end) != 0) throw std::runtime_error("pipe");
    child_ = ::fork();
    char byte = 0;
    if (child_ == 0) {
      ::close(end[1]);
      Database other(place, 1);
      other.Do("BEGIN EXCLUSIVE");
      if (::write(ready[1], &byte, 1) != 1 || ::read(end[0], &byte, 1) < 0) ::_exit(1);
      ::_exit(0);  // the lock ends with the process
    }
    ::close(ready[1]), ::close(end[0]);
    end_ = end[1];
    if (::read(ready[0], &byte, 1) != 1) throw std::runtime_error("no lock");
    ::close(ready[0]);
  }
  ~LockOfAnother() {
    ::close(end_);
    ::waitpid(child_, nullptr, 0);
  }
  LockOfAnother(const LockOfAnother&) = delete;
  LockOfAnother& operator=(const LockOfAnother&) = delete;

 private:
  pid_t child_ = -1;
  int end_ = -1;
};

// Records in a folder of their own, below a home of their own.
struct Lab {
  test::TempFolder home;
  fs::path folder = home / "lab", backup = home / "backup";
  std::string place = (folder / "records.sqlite").string();
  std::unique_ptr<LockOfAnother> lock;
  RecordsOptions options;
  Lab() {
    ::setenv("XDG_DATA_HOME", (home / "data").c_str(), 1);
    fs::create_directory(folder);
    options.timeout = 1;
  }
  // In the folder, which may have been put in place since.
  void AddTrainees() {
    Records records(place, options);
    AddTrainee(records, test::NewTrainee("T-1"));
    const AttemptRecord attempt = test::Attempt(
        records, StartSession(records, "T-1", "test", "mouse"), test::SampleExercise());
    fs::create_directories((folder / attempt.log).parent_path());
    WriteAtomically(folder / attempt.log, "log");
    fs::copy_file(place, backup);
  }
  void Restore() const {
    fs::remove_all(place);
    fs::copy_file(backup, place);
  }
  void Replace(const std::string& text) const {
    fs::remove(place);
    std::ofstream(place) << text;
  }
};

struct FaultCase {
  const char* name;
  const char* before;  // words of the sentence, before an attempt and during one
  const char* during;
  std::function<void(Lab&)> make, mend;
  bool needs_user = false;    // root may write everything, so that another user tries it
  bool needs_a_disk = false;  // a small file system of its own
  friend void PrintTo(const FaultCase& fault, std::ostream* out) { *out << fault.name; }
};

const FaultCase kFaults[] = {
    {"Locked", "locked by another program", "locked by another program",
     [](Lab& lab) { lab.lock = std::make_unique<LockOfAnother>(lab.place); },
     [](Lab& lab) { lab.lock.reset(); }},
    {"NewerSchema", "update the program", "update the program",
     [](Lab& lab) {
       Database(lab.place, 1).Do("UPDATE meta SET value = '99' WHERE key = 'schema'");
     },
     [](Lab& lab) {
       Database(lab.place, 1).Do("UPDATE meta SET value = '1' WHERE key = 'schema'");
     }},
    {"Text", "restore a backup", "moved or replaced",
     [](Lab& lab) { lab.Replace(std::string(5000, 'x')); }, [](Lab& lab) { lab.Restore(); }},
    {"WrittenOver", "restore a backup", "restore a backup",
     [](Lab& lab) {  // the same file, not another in its place
       std::fstream(lab.place, std::ios::in | std::ios::out) << std::string(9000, 'x');
     },
     [](Lab& lab) { lab.Restore(); }},
    {"Empty", "restore a backup", "moved or replaced", [](Lab& lab) { lab.Replace(""); },
     [](Lab& lab) { lab.Restore(); }},
    {"Truncated", "restore a backup", "restore a backup",
     [](Lab& lab) { fs::resize_file(lab.place, 5000); }, [](Lab& lab) { lab.Restore(); }},
    {"Folder", "is a folder", "moved or replaced",
     [](Lab& lab) {
       fs::remove(lab.place);
       fs::create_directory(lab.place);
     },
     [](Lab& lab) { lab.Restore(); }},
    {"ReadOnlyFile", "can only be read", "", [](Lab& lab) { ::chmod(lab.place.c_str(), 0444); },
     [](Lab& lab) { ::chmod(lab.place.c_str(), 0644); }, true},
    {"ReadOnlyFolder", "can only be read", "can only be read",
     [](Lab& lab) {
       ::chmod(lab.place.c_str(), 0444);
       ::chmod(lab.folder.c_str(), 0555);
     },
     [](Lab& lab) {
       ::chmod(lab.folder.c_str(), 0755);
       ::chmod(lab.place.c_str(), 0644);
     },
     true},
    {"FullDisk", "make room", "make room",
     [](Lab& lab) {
       std::ofstream fill(lab.folder / "fill");
       for (const std::string block(4096, 'x'); fill.flush();) fill << block;
     },
     [](Lab& lab) { fs::remove(lab.folder / "fill"); }, false, true},
};

AttemptPlan Plan() {
  AttemptPlan plan;
  plan.trainee = "T-1";
  plan.exercise = test::SampleExercise();
  plan.scene = "Demo";
  plan.mode = AttemptMode::kTest;
  return plan;
}

void AddFrames(KeptAttempt& kept) {
  const std::vector<simulation::AttemptFrame> frames(200);
  kept.Add(frames, {});
}

// Claims about one scenario, gathered, since some of them run in another process.
struct Claims {
  std::string failed;
  void Expect(bool holds, const std::string& claim) {
    if (!holds) failed += claim + "\n";
  }
  void ExpectSentence(const std::string& sentence, const char* words) {
    Expect(sentence.find(words) != std::string::npos,
           fmt::format("\"{}\" does not say \"{}\"", sentence, words));
    Expect(sentence.find('\n') == std::string::npos, "more than a line: " + sentence);
  }
};

// Does what the next start does; then the attempt is there once, and the earlier one still is.
void ExpectArrived(Lab& lab, const std::string& id, bool later, Claims& claims) {
  Records records(lab.place, lab.options);
  const Synced synced = SyncOutbox(records, lab.folder);
  claims.Expect(synced.refused.empty() && synced.fresh == (later ? 1 : 0),
                fmt::format("{} attempts arrived", synced.fresh));
  claims.Expect(SyncOutbox(records, lab.folder).fresh == 0, "it arrives twice");
  RecoverAttempts(records, {});
  const auto attempts = AttemptsOf(records, "T-1");
  claims.Expect(attempts.size() == 2, fmt::format("{} attempts are there", attempts.size()));
  const auto kept = ReadAttempt(records, id);
  claims.Expect(kept && kept->outcome == AttemptOutcome::kFailed && kept->metrics.size() == 3,
                "it is not whole");
  try {
    const auto log = simulation::ReadAttempt(lab.folder / LogNameOf(id));
    claims.Expect(!log.frames.empty(), "its log is empty");
  } catch (const Error& fault) {
    claims.Expect(false, fmt::format("its log is lost: {}", fault.what()));
  }
}

std::string DuringTheAttempt(Lab& lab, const FaultCase& fault) {
  Claims claims;
  lab.AddTrainees();
  std::string id;
  bool arrives_later = false;  // a file that is open already may take it
  {
    Records records(lab.place, lab.options);
    const SessionRow session = StartSession(records, "T-1", "test", "mouse");
    KeptAttempt kept(&records, lab.folder, session, Plan());
    id = kept.record().id;
    AddFrames(kept);
    fault.make(lab);
    const std::string where = kept.Finish(&records, test::SampleResult());
    claims.ExpectSentence(where, fault.during);
    arrives_later = !where.empty();
  }
  fault.mend(lab);
  ExpectArrived(lab, id, arrives_later, claims);
  return claims.failed;
}

std::string BeforeTheAttempt(Lab& lab, const FaultCase& fault) {
  Claims claims;
  lab.AddTrainees();
  fault.make(lab);
  std::unique_ptr<Records> records;
  std::string sentence;
  try {
    records = std::make_unique<Records>(lab.place, lab.options);
    StartSession(*records, "T-1", "test", "mouse");
  } catch (const Error& refused) {
    sentence = refused.what();
  }
  claims.ExpectSentence(sentence, fault.before);
  std::string id;
  {
    KeptAttempt kept(records.get(), lab.folder, std::nullopt, Plan());
    id = kept.record().id;
    for (const std::string& notice : kept.notices()) claims.Expect(false, notice);
    AddFrames(kept);
    claims.ExpectSentence(kept.Finish(records.get(), test::SampleResult()), "kept in");
  }
  records.reset();
  fault.mend(lab);
  ExpectArrived(lab, id, true, claims);
  return claims.failed;
}

// Runs a scenario in a process of its own, as another user or on a disk of its own. Returns what
// failed, or "skip: " and why.
std::string InAnotherProcess(const FaultCase& fault,
                             std::string (*scenario)(Lab&, const FaultCase&)) {
  int pipe[2] = {};
  if (::pipe(pipe) != 0) return "pipe";
  const pid_t child = ::fork();
  if (child == 0) {
    std::string said;
    try {
      if (fault.needs_a_disk && ::unshare(CLONE_NEWNS) != 0)
        said = "skip: only root can mount a small disk";
      if (fault.needs_user && ::geteuid() == 0 && ::setuid(65534) != 0)
        said = "skip: root cannot become another user";
      if (said.empty()) {
        Lab lab;
        constexpr const char* kSize = "size=1m";
        if (fault.needs_a_disk && (::mount("", "/", "", MS_REC | MS_PRIVATE, nullptr) != 0 ||
                                   ::mount("tmpfs", lab.folder.c_str(), "tmpfs", 0, kSize) != 0))
          said = "skip: only root can mount a small disk";
        else
          said = scenario(lab, fault);
        if (fault.needs_a_disk) ::umount2(lab.folder.c_str(), MNT_DETACH);
      }
    } catch (const std::exception& thrown) {
      said = std::string("thrown: ") + thrown.what();
    }
    const auto written = ::write(pipe[1], said.data(), said.size());
    ::_exit(written == static_cast<ssize_t>(said.size()) ? 0 : 1);
  }
  ::close(pipe[1]);
  std::string said;
  char buffer[4096];
  for (ssize_t count = 0; (count = ::read(pipe[0], buffer, sizeof buffer)) > 0;)
    said.append(buffer, static_cast<std::size_t>(count));
  ::close(pipe[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  return status == 0 ? said : "the process ended with status " + std::to_string(status);
}

class FaultOfRecords : public testing::TestWithParam<FaultCase> {
 protected:
  static void Try(std::string (*scenario)(Lab&, const FaultCase&)) {
    const std::string failed = InAnotherProcess(GetParam(), scenario);
    if (failed.starts_with("skip: ")) GTEST_SKIP() << "SKIPPED: " << failed.substr(6);
    EXPECT_EQ(failed, "");
  }
};

TEST_P(FaultOfRecords, BeforeAnAttemptKeepsItForLater) { Try(BeforeTheAttempt); }
TEST_P(FaultOfRecords, DuringAnAttemptKeepsItForLater) { Try(DuringTheAttempt); }

std::string NameOf(const testing::TestParamInfo<FaultCase>& fault) { return fault.param.name; }

INSTANTIATE_TEST_SUITE_P(Each, FaultOfRecords, testing::ValuesIn(kFaults), NameOf);

}  // namespace
}  // namespace arthro::app
