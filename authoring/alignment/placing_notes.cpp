#include "authoring/alignment/placing_notes.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "simulation/core/json_text.h"
#include "simulation/scene/json/field_json.h"
#include "simulation/scene/json/file_schema.h"
#include "simulation/scene/json/scene_json.h"
#include "simulation/scene/limits/scene_limits.h"

namespace arthro::authoring {
namespace {

constexpr const char* kNotesSchema = "arthroscene.placing/1";

// The notes as JSON has them.
struct PairInNotes {
  LandmarkPair pair;
  template <class V>
  void Visit(V&& v) {
    constexpr Range kSigma{0, 2};
    ScenePoint& point = pair.scene;
    v("name", pair.name, Any{}, "", "Name of the landmark.");
    v("model", pair.x_in_tissue, Required{kCoordinate}, "m",
      "Point of the model in the tissue's own frame.");
    v("place", point.x_in_portal, Required{kCoordinate}, "m", "Its place in the portal frame.");
    v("eye", point.eye, kCoordinate, "m", "Centre of the picture in which it was clicked.");
    v("px_per_radian", point.px_per_radian, Range{0, 1e6}, "",
      "Scale of that picture; 0: the place was given by coordinates.");
    v("lateral_sigma", point.lateral_sigma, kSigma, "m",
      "Standard error across the line of sight.");
    v("range_sigma", point.range_sigma, kSigma, "m", "Standard error along the line of sight.");
    v("guessed", point.is_guessed, LeftOutAt{false, Any{}}, "", "Whether its range was guessed.");
    v("left_out", pair.is_left_out, LeftOutAt{false, Any{}}, "", "Whether the author excluded it.");
  }
};

struct LandmarksInNotes {
  TissueLandmarks own;  // without its pairs
  std::vector<PairInNotes> pairs;
  template <class V>
  void Visit(V&& v) {
    v("tissue", own.tissue, Required{Any{}}, "", "Name of the tissue.");
    v("solves_scale", own.solves_scale, LeftOutAt{false, Any{}}, "",
      "Whether the scale is solved for.");
    v("pairs", pairs, Any{}, "", "Its pairs, in the order in which they were placed.");
  }
};

struct ImportInFile {
  ImportFrame frame;
  template <class V>
  void Visit(V&& v) {
    v("tissue", frame.tissue, Required{Any{}}, "", "Name of the tissue.");
    v("group", frame.group, Range{0, 1e6}, "", "Number that it shares with its group.");
    v("origin", frame.origin, Range{-1e3, 1e3}, "m", "Origin of the own frame in the file.");
  }
};

struct NotesInFile {
  std::vector<LandmarksInNotes> landmarks;
  std::vector<ImportInFile> imports;
  template <class V>
  void Visit(V&& v) {
    v("landmarks", landmarks, Any{}, "", "Landmarks of each tissue.");
    v("imports", imports, Any{}, "", "Frames of imported surfaces.");
  }
};

template <class Entry>
auto EntryOf(std::vector<Entry>& entries, const std::string& tissue) {
  return std::find_if(entries.begin(), entries.end(),
                      [&](const Entry& entry) { return entry.tissue == tissue; });
}

// The notes of a scene; nothing where it has none, or some that cannot be read.
std::optional<PlacingNotes> ReadNotes(const Scene& scene) {
  const auto text = scene.extensions.find(kPlacingKey);
  if (text == scene.extensions.end()) return std::nullopt;
  try {
    return NotesFromText(text->second);
  } catch (const Error&) {
    return std::nullopt;  // notes are a convenience, and no reason not to open a scene
  }
}

// Notes that cannot be read, as those of a later version, stay as they are.
template <class Change>
void ChangeNotes(Scene& scene, const Change& change) {
  std::optional<PlacingNotes> notes = ReadNotes(scene);
  if (!notes) return;
  change(*notes);
  PutNotes(scene, *notes);
}

template <class Entry>
void PutEntry(std::vector<Entry>& entries, Entry entry) {
  const auto own = EntryOf(entries, entry.tissue);
  if (own != entries.end())
    *own = std::move(entry);
  else
    entries.push_back(std::move(entry));
}

template <class Entry>
const Entry* Find(const std::vector<Entry>& entries, const std::string& tissue) {
  for (const Entry& entry : entries)
    if (entry.tissue == tissue) return &entry;
  return nullptr;
}

}  // namespace

PlacingNotes NotesOf(const Scene& scene) { return ReadNotes(scene).value_or(PlacingNotes()); }

void PutNotes(Scene& scene, const PlacingNotes& notes) {
  if (notes.empty())
    scene.extensions.erase(kPlacingKey);
  else
    scene.extensions[kPlacingKey] = NotesText(notes);
}

const TissueLandmarks* LandmarksOf(const PlacingNotes& notes, const std::string& tissue) {
  return Find(notes.landmarks, tissue);
}

const ImportFrame* FrameOf(const PlacingNotes& notes, const std::string& tissue) {
  return Find(notes.imports, tissue);
}

void Put(PlacingNotes& notes, TissueLandmarks landmarks) {
  if (landmarks.pairs.empty())
    std::erase_if(notes.landmarks, [&](const auto& own) { return own.tissue == landmarks.tissue; });
  else
    PutEntry(notes.landmarks, std::move(landmarks));
}

void Put(PlacingNotes& notes, ImportFrame frame) { PutEntry(notes.imports, std::move(frame)); }

void RenameInNotes(Scene& scene, const std::string& from, const std::string& to) {
  ChangeNotes(scene, [&](PlacingNotes& notes) {
    const auto rename = [&](auto& entries) {
      const auto own = EntryOf(entries, from);
      if (own == entries.end()) return;
      if (to.empty())
        entries.erase(own);
      else
        own->tissue = to;
    };
    rename(notes.landmarks);
    rename(notes.imports);
  });
}

void MirrorInNotes(Scene& scene, const std::string& tissue, double at) {
  ChangeNotes(scene, [&](PlacingNotes& notes) {
    if (const auto own = EntryOf(notes.landmarks, tissue); own != notes.landmarks.end())
      for (LandmarkPair& pair : own->pairs) pair.x_in_tissue.x = 2 * at - pair.x_in_tissue.x;
    std::erase_if(notes.imports, [&](const ImportFrame& own) { return own.tissue == tissue; });
  });
}

void MoveNotes(Scene& scene, const std::function<glm::dvec3(const glm::dvec3&)>& move) {
  ChangeNotes(scene, [&](PlacingNotes& notes) {
    for (TissueLandmarks& own : notes.landmarks)
      for (LandmarkPair& pair : own.pairs) {
        ScenePoint& point = pair.scene;
        const double before = glm::distance(point.x_in_portal, point.eye);
        point.x_in_portal = move(point.x_in_portal);
        point.eye = move(point.eye);
        const double growth =
            before > 0 ? glm::distance(point.x_in_portal, point.eye) / before : 1.0;
        point.lateral_sigma *= growth;
        point.range_sigma *= growth;
      }
  });
}

std::vector<LandmarkPair> OnRelief(std::vector<LandmarkPair> pairs, const LoadedScene& scene,
                                   ReliefOrigin unstated) {
  for (LandmarkPair& pair : pairs) {
    const glm::dvec3 way = pair.scene.x_in_portal - pair.scene.eye;
    if (pair.scene.px_per_radian <= 0 || glm::length(way) <= 0) continue;
    const Sight sight{pair.scene.eye, glm::normalize(way), pair.scene.px_per_radian};
    if (const auto now = PointOnRelief(scene, sight, unstated)) pair.scene = *now;
  }
  return pairs;
}

std::string NotesText(const PlacingNotes& notes) {
  nlohmann::ordered_json json;
  json["schema"] = kNotesSchema;
  NotesInFile in_file;
  for (const TissueLandmarks& own : notes.landmarks) {
    LandmarksInNotes& entry = in_file.landmarks.emplace_back();
    entry.own.tissue = own.tissue;
    entry.own.solves_scale = own.solves_scale;
    for (const LandmarkPair& pair : own.pairs) entry.pairs.push_back({pair});
  }
  for (const ImportFrame& frame : notes.imports) in_file.imports.push_back({frame});
  in_file.Visit(FieldWriter(json));
  return json.dump();
}

PlacingNotes NotesFromText(const std::string& text, const std::filesystem::path& file) {
  NotesInFile in_file = FromJsonFile<NotesInFile>(text, kNotesSchema, "notes of placing", file);
  PlacingNotes notes;
  for (LandmarksInNotes& entry : in_file.landmarks) {
    for (PairInNotes& pair : entry.pairs) entry.own.pairs.push_back(std::move(pair.pair));
    notes.landmarks.push_back(std::move(entry.own));
  }
  for (ImportInFile& entry : in_file.imports) notes.imports.push_back(std::move(entry.frame));
  return notes;
}

}  // namespace arthro::authoring
