// The tissues of a document as their author's cuts leave them: what the pictures show of them while
// no session runs, the same that a session begins with. Computed when asked for and kept as long as
// it is that of the document.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "authoring/project/document.h"
#include "simulation/tissue/body/deformable_body.h"

namespace arthro::app {

class CutSkins {
 public:
  // In the tissue's own frame. Null: the tissue is whole, or its cuts cannot be made.
  std::shared_ptr<const simulation::BodySkin> SkinOf(const authoring::Document& document,
                                                     int tissue);
  // Why the last one asked for could not be made; empty: it could.
  const std::string& fault() const { return fault_; }

 private:
  struct Made {
    // Input.
    std::shared_ptr<const SurfaceMesh> surface;
    double scale = 0;
    std::vector<Cut> cuts;
    std::vector<Ball> fixed;
    // Result.
    std::shared_ptr<const simulation::SolidField> whole;  // field of surface and scale
    std::shared_ptr<const simulation::BodySkin> skin;
    std::string fault;
  };
  std::vector<Made> made_;  // one per tissue
  std::string fault_;
};

}  // namespace arthro::app
