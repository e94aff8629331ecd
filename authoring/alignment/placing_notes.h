// Notes that an author made while placing the tissues of a scene, so that it can be taken up again:
// the pairs of landmarks of each tissue, and the frames of the files from which surfaces were
// imported. Kept in scene.json beside the values of the scene, so that the history, saves and
// copies have them too. m; model points in the tissue's own frame, scene points in the portal
// frame.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "authoring/alignment/landmark_alignment.h"

namespace arthro::authoring {

struct TissueLandmarks {
  std::string tissue;
  bool solves_scale = false;
  std::vector<LandmarkPair> pairs;
  friend bool operator==(const TissueLandmarks&, const TissueLandmarks&) = default;
};

// Surfaces of one knee lie in one frame, so that a further one can be placed beside the others, and
// all can be moved together.
struct ImportFrame {
  std::string tissue;
  int group = 0;           // equal for surfaces that keep their places to one another
  glm::dvec3 origin{0.0};  // the tissue's own origin in the file
  friend bool operator==(const ImportFrame&, const ImportFrame&) = default;
};

struct PlacingNotes {
  std::vector<TissueLandmarks> landmarks;
  std::vector<ImportFrame> imports;
  bool empty() const { return landmarks.empty() && imports.empty(); }
  friend bool operator==(const PlacingNotes&, const PlacingNotes&) = default;
};

// Key of the notes at the top of scene.json.
inline constexpr const char* kPlacingKey = "x-placing";
// The notes of a scene; empty where it has none, or those of another version.
PlacingNotes NotesOf(const Scene& scene);
void PutNotes(Scene& scene, const PlacingNotes& notes);

// Landmarks and frame of a tissue; null: it has none.
const TissueLandmarks* LandmarksOf(const PlacingNotes& notes, const std::string& tissue);
const ImportFrame* FrameOf(const PlacingNotes& notes, const std::string& tissue);

// Replaces or adds an entry. Landmarks without a pair are removed.
void Put(PlacingNotes& notes, TissueLandmarks landmarks);
void Put(PlacingNotes& notes, ImportFrame frame);
// For a tissue of the scene that was renamed, removed (an empty name), or mirrored in the plane x =
// `at` of its own frame, after which it fits its file no more.
void RenameInNotes(Scene& scene, const std::string& from, const std::string& to);
void MirrorInNotes(Scene& scene, const std::string& tissue, double at);
// For a scene whose points all moved; `move` takes points of the portal frame.
void MoveNotes(Scene& scene, const std::function<glm::dvec3(const glm::dvec3&)>& move);

// The pairs with the places where their clicks meet the relief of `scene`, which may be another one
// than that on which they were placed. `unstated`: as for PointOnRelief.
std::vector<LandmarkPair> OnRelief(std::vector<LandmarkPair> pairs, const LoadedScene& scene,
                                   ReliefOrigin unstated);

// JSON text, arthroscene.placing/1. Throws Error(kBadData) with the key and what is wrong.
std::string NotesText(const PlacingNotes& notes);
PlacingNotes NotesFromText(const std::string& text, const std::filesystem::path& file = {});

}  // namespace arthro::authoring
