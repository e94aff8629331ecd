// An author's cuts and regions of one tissue from and to its JSON object in scene.json: keys "cuts"
// and "regions".
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "simulation/scene/json_object_reader.h"
#include "simulation/scene/tissue_parts.h"

namespace arthro {

void ReadCuts(JsonObjectReader& tissue, std::vector<Cut>& cuts);
void ReadRegions(JsonObjectReader& tissue, std::vector<Region>& regions);

nlohmann::ordered_json JsonFromCut(const Cut& cut);
nlohmann::ordered_json JsonFromRegion(const Region& region);

// [x, y] or [x, y, z].
template <class V>
nlohmann::ordered_json JsonFromPoint(const V& v) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (int i = 0; i < V::length(); ++i) json.push_back(v[i]);
  return json;
}

// [w, x, y, z].
inline nlohmann::ordered_json JsonFromQuaternion(const glm::dquat& q) {
  return {q.w, q.x, q.y, q.z};
}

}  // namespace arthro
