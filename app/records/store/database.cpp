#include "app/records/store/database.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <deque>
#include <fcntl.h>
#include <filesystem>
#include <limits>
#include <regex>
#include <soci/postgresql/soci-postgresql.h>
#include <soci/soci.h>
#include <soci/sqlite3/soci-sqlite3.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

// Makes the file for its owner alone; SQLite gives its journal the same mode.
void MakePrivateFile(const fs::path& file) {
  std::error_code fault;
  const fs::path folder = file.parent_path();
  if (!folder.empty() && !fs::exists(folder, fault)) {
    fs::create_directories(folder, fault);
    if (fault)
      throw Error(Code::kFile,
                  "the folder of the records could not be made: " + WhyNotWritten(fault.value()),
                  folder);
    fs::permissions(folder, fs::perms::owner_all, fault);
  }
  const int made = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (made >= 0) {
    ::close(made);
    return;
  }
  const int why = errno;
  if (fs::is_directory(file, fault))
    throw Error(Code::kFile,
                "this is a folder; name a file for the records, or move the folder away", file);
  // A file that can only be read is opened all the same, so that results can be looked at.
  if (!fs::is_regular_file(file, fault))
    throw Error(Code::kFile, "the records could not be opened: " + WhyNotWritten(why), file);
}

// Quotes a value of SOCI's connection strings.
std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string WithoutPassword(const std::string& connection) {
  return std::regex_replace(connection, std::regex("(//[^:/@]*):[^@]*@"), "$1@");
}

// A server that does not answer is given up after `timeout`.
std::string WithTimeout(const std::string& connection, double timeout) {
  if (connection.find("connect_timeout") != std::string::npos) return connection;
  const char separator = connection.find('?') == std::string::npos ? '?' : '&';
  return fmt::format("{}{}connect_timeout={}", connection, separator,
                     static_cast<int>(std::ceil(timeout)));
}

// Places for the values of one statement; they stay where they are while it runs.
struct Bound {
  enum class Type { kWhole, kNumber, kText } type = Type::kText;
  long long whole = 0;
  double number = 0;
  std::string text;
  soci::indicator indicator = soci::i_null;

  void Set(const Cell& cell) {
    indicator = soci::i_ok;
    if (const auto* value = std::get_if<std::int64_t>(&cell)) {
      whole = *value;
      number = static_cast<double>(*value);
    } else if (const auto* real = std::get_if<double>(&cell); real && std::isfinite(*real)) {
      number = *real;
    } else if (const auto* words = std::get_if<std::string>(&cell)) {
      text = *words;
    } else {
      indicator = soci::i_null;
    }
  }
};

// One place per column, typed by its first value that is there.
std::deque<Bound> PlacesFor(const std::vector<Row>& rows) {
  std::deque<Bound> places(rows.empty() ? 0 : rows.front().size());
  for (std::size_t i = 0; i < places.size(); ++i)
    for (const Row& row : rows) {
      if (std::holds_alternative<std::monostate>(row.at(i))) continue;
      places[i].type = std::holds_alternative<std::int64_t>(row[i]) ? Bound::Type::kWhole
                       : std::holds_alternative<double>(row[i])     ? Bound::Type::kNumber
                                                                    : Bound::Type::kText;
      break;
    }
  return places;
}

void Bind(soci::statement& statement, std::deque<Bound>& places) {
  for (Bound& place : places) switch (place.type) {
      case Bound::Type::kWhole:
        statement.exchange(soci::use(place.whole, place.indicator));
        break;
      case Bound::Type::kNumber:
        statement.exchange(soci::use(place.number, place.indicator));
        break;
      case Bound::Type::kText:
        statement.exchange(soci::use(place.text, place.indicator));
        break;
    }
}

Cell CellAt(const soci::row& row, std::size_t i) {
  if (row.get_indicator(i) == soci::i_null) return {};
  switch (row.get_properties(i).get_data_type()) {
    case soci::dt_integer:
      return static_cast<std::int64_t>(row.get<int>(i));
    case soci::dt_long_long:
      return static_cast<std::int64_t>(row.get<long long>(i));
    case soci::dt_unsigned_long_long:
      return static_cast<std::int64_t>(row.get<unsigned long long>(i));
    case soci::dt_double:
      return row.get<double>(i);
    default:
      return row.get<std::string>(i);
  }
}

// The sentence for a code of SQLite [sqlite.org/rescode.html].
Error SqliteFault(int code, const std::string& text, const std::string& file) {
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {Code::kFile,
              "the records are locked by another program for too long; close it, then try again",
              file};
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return {Code::kFile,
              "the records can only be read; give this user the right to write the file and its "
              "folder",
              file};
    case SQLITE_FULL:
      return {Code::kFile, "the records could not be written: the disk is full; make room on it",
              file};
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return {Code::kBadData, "this is no database of records, or it is damaged; restore a backup",
              file};
    case SQLITE_CANTOPEN:
      return {Code::kFile, "the records could not be opened; check the folder and its rights",
              file};
    case SQLITE_IOERR:
      return {Code::kFile,
              "the records could not be read or written: the disk is full, or it fails; make room "
              "on it",
              file};
    default:
      return {(code & 0xff) == SQLITE_CONSTRAINT ? Code::kBadData : Code::kFile,
              fmt::format("the records refused the work: {}", text), file};
  }
}

Error NoAnswer(const std::string& words) {
  return {Code::kFile,
          fmt::format("the server of the records ({}) does not answer; attempts go to the outbox "
                      "until `arthroscene records sync` reaches it",
                      words)};
}

Error ServerFault(const soci::soci_error& fault, const std::string& words) {
  std::string text = fault.get_error_message();
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20; }, ' ');
  // Only the server's own words are of use to a reader.
  if (const auto own = text.find("ERROR:"); own != text.npos)
    text = text.substr(text.find_first_not_of(' ', own + 6));
  while (text.ends_with(' ')) text.pop_back();
  // SOCI gives no category to a connection that cannot be made.
  if (text.starts_with("Cannot establish connection")) {
    if (text.find("FATAL") != std::string::npos)
      return {Code::kFile,
              fmt::format("the server of the records refuses {}; check the user, the password and "
                          "the name of the database",
                          words)};
    return NoAnswer(words);
  }
  switch (fault.get_error_category()) {
    case soci::soci_error::connection_error:
    case soci::soci_error::system_error:
      return NoAnswer(words);
    case soci::soci_error::no_privilege:
      return {Code::kFile,
              fmt::format("the server of the records ({}) does not allow this to its user: {}; ask "
                          "its administrator for the role",
                          words, text)};
    default:
      return {fault.get_error_category() == soci::soci_error::constraint_violation ? Code::kBadData
                                                                                   : Code::kFile,
              fmt::format("the records on {} refused the work: {}", words, text)};
  }
}

}  // namespace

bool IsServer(const std::string& connection) {
  return connection.starts_with("postgresql://") || connection.starts_with("postgres://");
}

struct Database::Link {
  soci::session session;
};

Database::Database(const std::string& connection, double timeout)
    : kind_(IsServer(connection) ? DatabaseKind::kPostgresql : DatabaseKind::kSqlite),
      words_(WithoutPassword(connection)),
      link_(std::make_unique<Link>()) {
  if (connection.empty())
    throw Error(Code::kBadArgument, "the place of the records is empty; name a file or a server");
  if (kind_ == DatabaseKind::kSqlite && connection.find("://") != std::string::npos)
    throw Error(Code::kBadArgument,
                fmt::format("the records are at {}, which is neither a file nor an address that "
                            "begins with postgresql://",
                            words_));
  try {
    if (kind_ == DatabaseKind::kPostgresql) {
      link_->session.open(soci::postgresql, WithTimeout(connection, timeout));
      link_->session << "SET client_min_messages TO warning";
      return;
    }
    MakePrivateFile(connection);
    opened_ = FileIdOf(connection);
    link_->session.open(soci::sqlite3,
                        fmt::format("db={} timeout={}", Quoted(connection),
                                    std::max(1, static_cast<int>(std::ceil(timeout)))));
    std::string mode;
    link_->session << "PRAGMA foreign_keys=ON";
    link_->session << "PRAGMA synchronous=EXTRA";
    link_->session << "PRAGMA journal_mode=DELETE", soci::into(mode);
  } catch (const soci::soci_error&) {
    Refuse();
  }
}

Database::~Database() = default;

Database::FileId Database::FileIdOf(const std::string& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return {};
  return {status.st_dev, status.st_ino};
}

// Called while an error of SOCI is handled.
void Database::Refuse() const {
  if (kind_ == DatabaseKind::kSqlite && opened_ != FileIdOf(words_))
    throw Error(Code::kFile,
                "the file of the records was moved or replaced while it was open; put it back, or "
                "restore a backup",
                words_);
  try {
    throw;
  } catch (const soci::sqlite3_soci_error& fault) {
    throw SqliteFault(fault.result(), fault.get_error_message(), words_);
  } catch (const soci::soci_error& fault) {
    if (kind_ == DatabaseKind::kPostgresql) throw ServerFault(fault, words_);
    throw SqliteFault(SQLITE_CANTOPEN, fault.get_error_message(), words_);
  }
}

long Database::Do(const std::string& sql, const std::vector<Row>& rows) {
  if (rows.empty()) return 0;
  ++work_.statements;
  try {
    std::deque<Bound> places = PlacesFor(rows);
    soci::statement statement(link_->session);
    Bind(statement, places);
    statement.alloc();
    statement.prepare(sql);
    statement.define_and_bind();
    long changed = 0;
    for (const Row& row : rows) {
      for (std::size_t i = 0; i < places.size(); ++i) places[i].Set(row.at(i));
      statement.execute(true);
      changed += static_cast<long>(statement.get_affected_rows());
    }
    return changed;
  } catch (const soci::soci_error&) {
    Refuse();
  }
}

std::vector<Row> Database::Ask(const std::string& sql, const Row& values) {
  ++work_.statements;
  try {
    std::deque<Bound> places = PlacesFor({values});
    for (std::size_t i = 0; i < places.size(); ++i) places[i].Set(values[i]);
    soci::row fetched;
    soci::statement statement(link_->session);
    Bind(statement, places);
    statement.exchange(soci::into(fetched));
    statement.alloc();
    statement.prepare(sql);
    statement.define_and_bind();
    std::vector<Row> rows;
    for (bool more = statement.execute(true); more; more = statement.fetch()) {
      Row& row = rows.emplace_back();
      for (std::size_t i = 0; i < fetched.size(); ++i) row.push_back(CellAt(fetched, i));
    }
    work_.rows += static_cast<long>(rows.size());
    return rows;
  } catch (const soci::soci_error&) {
    Refuse();
  }
}

// A server that was away for a while is asked for a new connection once.
void Database::BeginOnServer() {
  try {
    Do("BEGIN");
  } catch (const Error&) {
    try {
      link_->session.reconnect();
    } catch (const soci::soci_error&) {
      Refuse();
    }
    Do("BEGIN");
  }
}

void Database::Write(const std::function<void()>& work) {
  if (kind_ == DatabaseKind::kSqlite)
    Do("BEGIN IMMEDIATE");
  else
    BeginOnServer();
  try {
    work();
    Do("COMMIT");
  } catch (...) {
    try {
      Do("ROLLBACK");
    } catch (const Error&) {
      // A connection that is lost has undone the transaction itself.
    }
    throw;
  }
}

std::int64_t WholeOf(const Cell& cell) {
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return *whole;
  const double number = NumberOf(cell);
  return std::isnan(number) ? 0 : static_cast<std::int64_t>(number);
}

double NumberOf(const Cell& cell) {
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  double value = std::numeric_limits<double>::quiet_NaN();
  if (const auto* text = std::get_if<std::string>(&cell))
    std::from_chars(text->data(), text->data() + text->size(), value);
  return value;
}

std::string TextOf(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *whole);
  if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{}", *number);
  return {};
}

}  // namespace arthro::app
