// Parts of the job `records`: each function adds one of its subcommands. Every one has --records.
#pragma once

#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace arthro::app {

// Place of the records: what --records gives, or else those of this user.
struct RecordsPlace {
  std::string connection;
  std::string Connection() const;  // throws Error without a home
};
std::shared_ptr<RecordsPlace> AddPlace(CLI::App& job);

// Name of the user, for the audit.
std::string UserWords();

void AddListRecords(CLI::App& records);
void AddShowRecords(CLI::App& records);
void AddExportRecords(CLI::App& records);
void AddImportRecords(CLI::App& records);
void AddSyncRecords(CLI::App& records);
void AddReferenceRecords(CLI::App& records);
void AddTraineeRecords(CLI::App& records);
void AddBackupRecords(CLI::App& records);
void AddCheckRecords(CLI::App& records);
void AddEraseRecords(CLI::App& records);

}  // namespace arthro::app
