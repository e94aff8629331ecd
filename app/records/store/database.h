// One connection to a database of records, SQLite or PostgreSQL, through SOCI; the only file that
// knows SOCI is database.cpp. Every fault of the database becomes one sentence.
//
// SQLite runs without a write-ahead log: the SQLite of Debian 12 can damage a database whose log
// two connections reset at once [SQLite, "The WAL Reset Bug", sqlite.org/wal.html].
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/records/store/cell.h"

namespace arthro::app {

enum class DatabaseKind { kSqlite, kPostgresql };

// Work of a connection since it was opened, so that tests can see what a page costs.
struct DatabaseWork {
  long statements = 0, rows = 0;  // rows: read
};

class Database {
 public:
  // `connection`: "postgresql://USER@HOST/NAME", or the file of an SQLite database, which is made
  // with its folder, for its owner alone. `timeout`: s to wait for another writer or a server.
  // Throws Error(kFile) where it cannot be opened, Error(kBadData) where it is no database.
  Database(const std::string& connection, double timeout);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  DatabaseKind kind() const { return kind_; }
  // The connection for messages, without a password.
  const std::string& words() const { return words_; }
  const DatabaseWork& work() const { return work_; }

  // Runs a statement once per row of values, which stand for :names in their order. A name stands
  // once. NaN is stored as nothing, since the databases read it differently. Returns the number of
  // rows that changed.
  long Do(const std::string& sql, const std::vector<Row>& rows = {{}});
  std::vector<Row> Ask(const std::string& sql, const Row& values = {});

  // Runs `work` in a transaction that holds the right to write from its begin, so that it never
  // fails half-way for lack of it. Undone where `work` throws.
  void Write(const std::function<void()>& work);

 private:
  struct Link;
  [[noreturn]] void Refuse() const;
  void BeginOnServer();

  // File of an SQLite database as it was opened; another one in its place is no longer the same.
  struct FileId {
    std::uint64_t device = 0, number = 0;
    friend bool operator==(const FileId&, const FileId&) = default;
  };
  static FileId FileIdOf(const std::string& file);  // zeros where it is not there

  DatabaseKind kind_;
  std::string words_;
  FileId opened_;
  DatabaseWork work_;
  std::unique_ptr<Link> link_;
};

// True for a connection to a server.
bool IsServer(const std::string& connection);

}  // namespace arthro::app
