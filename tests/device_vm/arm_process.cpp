#include "tests/device_vm/arm_process.h"

#include <fcntl.h>
#include <fstream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace arthro::test {

ArmProcess::ArmProcess(const std::string& serial) {
  static int number = 0;
  log_ = std::filesystem::temp_directory_path() / ("arm" + std::to_string(number++));
  int ends[2], answers[2];
  if (pipe2(ends, O_CLOEXEC) != 0 || pipe2(answers, O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe");
  process_ = fork();
  if (process_ == 0) {
    dup2(ends[0], STDIN_FILENO);
    dup2(answers[1], STDOUT_FILENO);
    execl("/bin/virtual_arm", "virtual_arm", serial.c_str(), log_.c_str(), nullptr);
    _exit(127);
  }
  close(ends[0]);
  close(answers[1]);
  commands_ = ends[1];
  answers_ = answers[0];
  Do("plug");
}

ArmProcess::~ArmProcess() {
  close(commands_);
  close(answers_);
  waitpid(process_, nullptr, 0);
  std::filesystem::remove(log_);
}

void ArmProcess::Begin(const std::string& line) {
  const std::string text = line + "\n";
  if (write(commands_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    throw std::runtime_error("the virtual arm does not listen");
  ++begun_;
}

void ArmProcess::Do(const std::string& line) {
  Begin(line);
  for (char answer; done_ < begun_; ++done_)
    if (read(answers_, &answer, 1) != 1)
      throw std::runtime_error("the virtual arm ended at \"" + line + "\"");
}

std::vector<ArmRecord> ArmProcess::Records() {
  Do("");  // the record is complete then
  std::vector<ArmRecord> records;
  std::ifstream stream(log_, std::ios::binary);
  ArmRecord record;
  while (stream.read(reinterpret_cast<char*>(&record), sizeof record)) records.push_back(record);
  return records;
}

double ArmProcess::TimeOf(ArmEvent event) {
  double t = -1;
  for (const ArmRecord& record : Records())
    if (record.event == event) t = Seconds(record.t_ns);
  return t;
}

}  // namespace arthro::test
