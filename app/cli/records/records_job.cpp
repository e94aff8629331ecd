// arthroscene records …: who did which exercise, and what leaves the records [records.md, What
// happens to an attempt].
#include "app/cli/records/records_job.h"

#include <array>
#include <pwd.h>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include "app/cli/jobs.h"
#include "app/records/store/records.h"

namespace arthro::app {

std::string RecordsPlace::Connection() const {
  return connection.empty() ? DefaultRecords() : connection;
}

std::shared_ptr<RecordsPlace> AddPlace(CLI::App& job) {
  auto place = std::make_shared<RecordsPlace>();
  job.add_option("--records", place->connection,
                 "Records: a file, or postgresql://USER@HOST/NAME. Those of this user lie in "
                 "~/.local/share/arthroscene/records.sqlite.")
      ->type_name("PLACE");
  return place;
}

std::string UserWords() {
  passwd entry{};
  passwd* user = nullptr;
  std::array<char, 4096> words{};
  ::getpwuid_r(::geteuid(), &entry, words.data(), words.size(), &user);
  return user != nullptr ? user->pw_name : "unknown";
}

void AddRecordsJob(CLI::App& program) {
  CLI::App* job = program.add_subcommand(
      "records", "Keep attempts of trainees: list, report, export, backup, erase.");
  job->require_subcommand(1);
  AddListRecords(*job);
  AddShowRecords(*job);
  AddExportRecords(*job);
  AddImportRecords(*job);
  AddSyncRecords(*job);
  AddReferenceRecords(*job);
  AddTraineeRecords(*job);
  AddBackupRecords(*job);
  AddCheckRecords(*job);
  AddEraseRecords(*job);
}

}  // namespace arthro::app
