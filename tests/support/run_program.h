// Runs the built program as a user would and keeps what it said.
#pragma once

#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>

#include "tests/support/build_paths.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {

struct ProgramResult {
  int exit_code = -1;  // 128 + signal where one ended it
  std::string out, err;
};

// `arguments` as typed in a shell; `environment` goes before the program ("DISPLAY= LANG=C").
inline ProgramResult RunProgram(const std::string& arguments, const std::string& environment = "") {
  TempFolder folder;
  const std::string out = (folder / "out").string(), err = (folder / "err").string();
  const std::string line =
      environment + " " ARTHRO_PROGRAM " " + arguments + " >" + out + " 2>" + err + " </dev/null";
  const int status = std::system(line.c_str());
  const auto read = [](const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  };
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read(out), read(err)};
}

}  // namespace arthro::test
