// Runs a job on a bad input and expects a refusal: exit code 1 and one sentence, within 2 s of
// processor time and 1 GB, with nothing left behind.
#pragma once

#include <string>
#include <vector>

namespace arthro::test {

struct Refusal {
  bool has_temporary_folder = true;
  bool writes_result = false;  // result file gives the reason
};

// Arguments that begin with OUT/ stand for files of a folder that is removed. Returns the sentence.
std::string RefusalOf(const std::vector<std::string>& arguments, const Refusal& refusal = {});

}  // namespace arthro::test
