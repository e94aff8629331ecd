#include "app/cli/flags/pixel_flags.h"

#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/flags/number_flags.h"

namespace arthro::app {

authoring::PixelBox BoxFromWords(const std::string& flag, const std::string& words) {
  const std::vector<double> px = NumbersFromWord(flag, words, {{0, 65535}, "px", true});
  if (px.size() != 4 || !(px[2] > 0) || !(px[3] > 0))
    throw CLI::ValidationError(
        flag,
        fmt::format("{} is not X,Y,W,H: left column, top row, width and height in px", words));
  const auto whole = [&](std::size_t i) { return static_cast<int>(px[i]); };
  return {whole(0), whole(1), whole(2), whole(3)};
}

std::pair<glm::dvec2, glm::dvec2> PixelsFromWord(const char* flag, std::string_view word,
                                                 const char* sentence) {
  const auto colon = word.find(':');
  const auto pixel = [&](std::string_view part) {
    const std::vector<double> numbers = NumbersFromWord(flag, part, {{0.0, 65535.0}, "px", false});
    if (numbers.size() != 2) throw CLI::ValidationError(flag, sentence);
    return glm::dvec2(numbers[0], numbers[1]);
  };
  if (colon == std::string_view::npos) throw CLI::ValidationError(flag, sentence);
  return {pixel(word.substr(0, colon)), pixel(word.substr(colon + 1))};
}

}  // namespace arthro::app
