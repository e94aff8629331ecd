#include "authoring/project/footage_record.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/fingerprint.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"
#include "simulation/scene/files/archive_io.h"
#include "simulation/scene/json/field_json.h"
#include "simulation/scene/json/field_schema.h"
#include "simulation/scene/json/file_schema.h"
#include "simulation/scene/json/scene_json.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "arthroscene.footage/1";
constexpr const char* kReport = "report";

// Videos of operations have gigabytes. Of a larger file its size and 64 pieces count, from its
// first byte to its last.
constexpr std::uintmax_t kWhole = std::uintmax_t{64} << 20;  // bytes
constexpr std::uintmax_t kPiece = std::uintmax_t{1} << 20;   // bytes
constexpr std::uintmax_t kPieces = 64;

std::string SampleOf(const fs::path& file) {
  std::error_code fault;
  const std::uintmax_t size = fs::file_size(file, fault);
  if (fault || size <= kWhole) return ReadWholeFile(file);
  std::ifstream stream(file, std::ios::binary);
  std::string sample = std::to_string(size);
  std::string piece(kPiece, '\0');
  for (std::uintmax_t i = 0; i < kPieces; ++i) {
    const std::uintmax_t at = (size - kPiece) / (kPieces - 1) * i;
    stream.seekg(static_cast<std::streamoff>(i + 1 == kPieces ? size - kPiece : at));
    stream.read(piece.data(), static_cast<std::streamsize>(kPiece));
    if (!stream)
      throw Error(Code::kFile, "could not be read to its end; copy it to another disk", file);
    sample += piece;
  }
  return sample;
}

void ReplaceAll(std::string& text, const std::string& from, const std::string& to) {
  if (from.empty()) return;
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
    text.replace(at, from.size(), to);
}

// Leaves entries of one kind in a list of the report, if it has that list. Whatever is of another
// kind is replaced by an empty one: it might hold a name.
void CleanList(Json& report, const char* key, Json::value_t kind) {
  if (!report.contains(key)) return;
  Json& list = report[key];
  if (!list.is_array()) list = Json::array();
  for (Json& entry : list)
    if (entry.type() != kind) entry = Json(kind);
}

}  // namespace

FootageRecord FootageFromJson(const std::string& text, const fs::path& file) {
  const auto check = [&](JsonObjectReader& reader, FootageRecord& record) {
    if (record.clips.empty()) return reader.Fault("clips", "must list the clips of the panorama");
    reader.Know(kReport);
    if (!reader.Has(kReport)) return;
    const Json report = ParseOrderedJson(text, Code::kBadData)[kReport];
    if (!report.is_object()) return reader.Fault(kReport, "must be the report of a panorama");
    record.report = report.dump(1) + "\n";
  };
  return FromJsonFile<FootageRecord>(text, kSchema, "a record of footage", file, check);
}

FootageRecord ReadFootage(const fs::path& file) {
  return FootageFromJson(ReadWholeFile(file, kMostJsonBytes), file);
}

std::string JsonFromFootage(const FootageRecord& record) {
  Json json;
  json["schema"] = kSchema;
  FootageRecord copy = record;
  copy.Visit(FieldWriter(json));
  if (!record.report.empty()) json[kReport] = ParseOrderedJson(record.report, Code::kBadData);
  return PrettyJson(json);
}

std::string FootageSchemaText() {
  auto fields = SchemaOfFields(FootageRecord());
  fields["properties"][kReport] = {
      {"type", "object"}, {"description", "Report of the panorama, by panorama-1.schema.json."}};
  return PrettyJson(FileSchema(kSchema, "Arthroscene record of footage, version 1",
                               "How the panorama of a scene was made: clips, choices and report.",
                               fields));
}

FootageRecord BesideScene(FootageRecord record, const fs::path& folder) {
  for (ClipFile& clip : record.clips)
    if (!clip.file.empty())
      clip.beside = fs::path(clip.file).lexically_relative(fs::absolute(folder)).generic_string();
  return record;
}

FootageRecord WithoutNames(FootageRecord record) {
  Json report;
  if (!record.report.empty()) report = ParseOrderedJson(record.report, Code::kBadData);
  if (!report.is_object()) report = Json::object();
  CleanList(report, "warnings", Json::value_t::string);
  CleanList(report, "clips", Json::value_t::object);
  CleanList(report, "frames", Json::value_t::object);
  for (std::size_t i = 0; i < record.clips.size(); ++i) {
    ClipFile& clip = record.clips[i];
    const std::string name = fmt::format("clip {}", i + 1);
    // Sentences may name the clip.
    if (report.contains("warnings"))
      for (Json& warning : report["warnings"])
        for (const std::string& old : {clip.file, clip.name})
          ReplaceAll(warning.get_ref<std::string&>(), old, name);
    if (report.contains("clips") && i < report["clips"].size()) report["clips"][i]["file"] = name;
    clip.name = name;
    clip.file.clear();
    clip.beside.clear();
  }
  if (report.contains("footage")) report["footage"] = "";
  if (report.contains("frames"))
    for (Json& frame : report["frames"]) frame["source"] = "";
  if (!record.report.empty()) record.report = report.dump(1) + "\n";
  return record;
}

std::string ClipFingerprint(const fs::path& clip) {
  std::error_code ignored;
  if (!fs::is_directory(clip, ignored)) return FingerprintOf(SampleOf(clip));
  std::vector<std::string> lines;
  for (const auto& entry : fs::directory_iterator(clip, ignored))
    if (entry.is_regular_file(ignored))
      lines.push_back(entry.path().filename().string() + " " +
                      FingerprintOf(ReadWholeFile(entry.path())) + "\n");
  std::sort(lines.begin(), lines.end());
  std::string all;
  for (const std::string& line : lines) all += line;
  return FingerprintOf(all);
}

fs::path FindClip(const ClipFile& clip, const fs::path& scene_folder) {
  std::error_code ignored;
  if (!clip.beside.empty() && !scene_folder.empty() && !IsArchive(scene_folder))
    if (fs::path file = (fs::absolute(scene_folder) / clip.beside).lexically_normal();
        fs::exists(file, ignored))
      return file;
  return !clip.file.empty() && fs::exists(clip.file, ignored) ? fs::path(clip.file) : fs::path();
}

std::string WordsOfMissingClip(const ClipFile& clip) {
  if (clip.file.empty())
    return fmt::format(
        "this scene was handed on without the place of its clip ({} frames); choose "
        "the clip to change its panorama",
        clip.frames);
  return fmt::format(
      "the clip {} is no longer at {}; choose where it lies now to change its "
      "panorama",
      clip.name, clip.file);
}

}  // namespace arthro::authoring
