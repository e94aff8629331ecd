// A PostgreSQL server of a test's own, in a temporary folder, reached by a socket there alone. It
// runs as the user postgres where the test is run by root, which PostgreSQL refuses.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <unistd.h>

#include <fmt/format.h>

#include "tests/support/temp_folder.h"

namespace arthro::test {

class PostgresServer {
 public:
  PostgresServer() {
    namespace fs = std::filesystem;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator("/usr/lib/postgresql", ignored))
      if (fs::exists(entry.path() / "bin/initdb")) programs_ = entry.path() / "bin";
    if (programs_.empty()) {
      why_none_ = "PostgreSQL is not installed (apt install postgresql)";
      return;
    }
    if (::geteuid() == 0) {
      as_ = "runuser -u postgres -- ";
      if (std::system(fmt::format("chown postgres {}", folder_.path().string()).c_str()) != 0) {
        why_none_ = "there is no user postgres, and root may not run the server";
        return;
      }
    }
    if (Run("initdb -N -A trust -U arthro -E UTF8 --locale=C -D " + Data()) != 0 || !Start())
      why_none_ = "the server of PostgreSQL did not start";
  }
  ~PostgresServer() { Stop(); }
  PostgresServer(const PostgresServer&) = delete;
  PostgresServer& operator=(const PostgresServer&) = delete;

  const std::string& why_none() const { return why_none_; }  // empty: it runs
  std::string connection() const {
    return fmt::format("postgresql://arthro@/postgres?host={}", folder_.path().string());
  }
  // Programs of PostgreSQL, such as pg_dump.
  const std::filesystem::path& programs() const { return programs_; }

  // Durability costs time, and the machine itself does not fail in a test.
  bool Start() {
    return Run(fmt::format("pg_ctl -w -t 120 -D {0} -l {1}/log -o \"-k {1} -c listen_addresses='' "
                           "-c fsync=off -c max_connections=60\" start",
                           Data(), folder_.path().string())) == 0;
  }
  void Stop() {
    if (!programs_.empty() && std::filesystem::exists(Data() + "/postmaster.pid"))
      Run("pg_ctl -w -m immediate -D " + Data() + " stop");
  }

 private:
  std::string Data() const { return (folder_ / "data").string(); }
  int Run(const std::string& arguments) const {
    return std::system(fmt::format("cd {} && {}{}/{} >/dev/null 2>&1", folder_.path().string(), as_,
                                   programs_.string(), arguments)
                           .c_str());
  }

  TempFolder folder_;
  std::filesystem::path programs_;
  std::string as_, why_none_;
};

}  // namespace arthro::test
