#include "app/editor/pictures/frame_times.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace arthro::app {
namespace {

// Seconds since the program was started, loading included; to a hundredth.
double ProcessAge() {
  std::ifstream stat("/proc/self/stat"), uptime("/proc/uptime");
  std::string text;
  std::getline(stat, text);
  // The 22nd field, counted from after the name in brackets, which may hold blanks.
  std::istringstream fields(text.substr(text.rfind(')') + 2));
  std::string field;
  for (int number = 3; number <= 22; ++number) fields >> field;
  double now = 0;
  uptime >> now;
  return now - std::stod(field) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

}  // namespace

FrameTimes::~FrameTimes() {
  for (auto& [mark, seconds] : seconds_) {
    std::sort(seconds.begin(), seconds.end());
    const auto at = [&seconds = seconds](double share) {
      return 1e3 *
             seconds[static_cast<std::size_t>(share * static_cast<double>(seconds.size() - 1))];
    };
    std::fprintf(stderr, "%s%s%zu frames, median %.1f ms, p99 %.1f ms, longest %.1f ms\n",
                 mark.c_str(), mark.empty() ? "" : ": ", seconds.size(), at(0.5), at(0.99),
                 at(1.0));
  }
}

void FrameTimes::Note(const std::string& mark, double seconds) {
  if (seconds_.empty()) std::fprintf(stderr, "first picture after %.0f ms\n", 1e3 * ProcessAge());
  seconds_[mark].push_back(seconds);
}

}  // namespace arthro::app
