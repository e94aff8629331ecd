#include "app/records/store/utc_time.h"

#include <chrono>
#include <cstdio>

#include <fmt/format.h>

namespace arthro::app {

using namespace std::chrono;

std::string UtcText(std::int64_t ms) {
  const sys_time<milliseconds> time{milliseconds(ms)};
  const auto day = floor<days>(time);
  const year_month_day d(day);
  const hh_mm_ss t(time - day);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", static_cast<int>(d.year()),
                     static_cast<unsigned>(d.month()), static_cast<unsigned>(d.day()),
                     t.hours().count(), t.minutes().count(), t.seconds().count(),
                     t.subseconds().count());
}

std::optional<std::int64_t> MillisecondsOf(const std::string& utc) {
  int y = 0, second = 0, hour = 0, minute = 0, ms = 0;
  unsigned m = 0, d = 0;
  if (std::sscanf(utc.c_str(), "%4d-%2u-%2uT%2d:%2d:%2d.%3dZ", &y, &m, &d, &hour, &minute, &second,
                  &ms) != 7)
    return std::nullopt;
  const sys_days day(year(y) / month(m) / std::chrono::day(d));
  return duration_cast<milliseconds>(
             (day + hours(hour) + minutes(minute) + seconds(second) + milliseconds(ms))
                 .time_since_epoch())
      .count();
}

std::string UtcNow() {
  return UtcText(duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count());
}

}  // namespace arthro::app
