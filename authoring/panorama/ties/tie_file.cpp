#include "authoring/panorama/ties/tie_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"
#include "simulation/scene/json/field_json.h"
#include "simulation/scene/json/field_schema.h"
#include "simulation/scene/json/file_schema.h"
#include "simulation/scene/json/scene_json.h"

namespace arthro::authoring {
namespace {

constexpr const char* kSchema = "arthroscene.ties/1";

}  // namespace

std::vector<FrameTie> ParseTies(const std::string& text, const std::filesystem::path& file) {
  const auto check = [](JsonObjectReader& reader, const TiesFile& ties) {
    for (std::size_t i = 0; i < ties.ties.size(); ++i) {
      const FrameTie& tie = ties.ties[i];
      const std::string key = fmt::format("ties[{}]", i);
      if (tie.other.has_value() == tie.panorama.has_value())
        return reader.Fault(key, "must have one partner: other or panorama");
      if (tie.other && tie.other->frame == tie.frame)
        return reader.Fault(key, "joins a frame to itself; name another frame");
    }
  };
  return FromJsonFile<TiesFile>(text, kSchema, "tie points", file, check).ties;
}

std::vector<FrameTie> ReadTies(const std::filesystem::path& file) {
  return ParseTies(ReadWholeFile(file, kMostJsonBytes), file);
}

std::string TiesSchemaText() {
  auto json = FileSchema(kSchema, "Arthroscene tie points, version 1",
                         "Points of the tissue in a frame that did not register, and their "
                         "partners, for `arthroscene panorama --ties`. This schema cannot express "
                         "that a pair has exactly one partner: other or panorama.",
                         SchemaOfFields(TiesFile()));
  return PrettyJson(json);
}

}  // namespace arthro::authoring
