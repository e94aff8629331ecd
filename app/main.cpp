#include <cerrno>
#include <csignal>
#include <cstdio>

#include "app/cli/command_line.h"
#include "simulation/core/atomic_file.h"

int main(int argc, char** argv) {
  // A full disk, a file-size limit and a closed pipe come as errors of the write, so that the job
  // can say so, remove what is unfinished and let devices go.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  const int result = arthro::app::RunCommandLine(argc, argv);
  // Printed text is part of the result.
  errno = 0;
  if ((std::fflush(stdout) == 0 && std::ferror(stdout) == 0) || result != 0) return result;
  std::fprintf(stderr, "arthroscene: standard output could not be written to its end: %s\n",
               errno != 0 ? arthro::WhyNotWritten(errno).c_str() : "some of it was lost");
  return 1;
}
