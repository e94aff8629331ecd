// Internals of Overview: the contents of its window. Portal frame, m. Tissues, their box and their
// balls are in overview_tissues.cpp, arms and rings of the handle in overview_gizmo.cpp.
#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <vtkActor.h>
#include <vtkBillboardTextActor3D.h>
#include <vtkBoxRepresentation.h>
#include <vtkBoxWidget2.h>
#include <vtkCallbackCommand.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "app/view/drawing/passes/context_render_window.h"
#include "app/view/overview/overview.h"
#include "app/view/overview/overview_parts.h"

namespace arthro::app {

inline const glm::dvec3 kScopeColour{0.25, 0.75, 0.80}, kInstrumentColour{0.95, 0.68, 0.25};

// Converts a tissue's pose to VTK's and back; drops shears by rounding.
vtkSmartPointer<vtkMatrix4x4> MatrixOf(const Pose& pose);
Pose PoseOf(const vtkMatrix4x4& matrix);

struct Overview::Parts {
  struct Model {
    vtkSmartPointer<vtkActor> actor;
    vtkSmartPointer<vtkPolyData> data;
    SurfaceMesh surface;
    Pose pose;
    bool is_hidden = false;
  };

  vtkNew<ContextRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkGenericRenderWindowInteractor> interactor;
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  vtkNew<vtkBoxWidget2> box;
  vtkNew<vtkBoxRepresentation> box_look;
  vtkNew<vtkCallbackCommand> asked_to_draw, box_moved;

  vtkSmartPointer<vtkActor> relief = MakeActor({1, 1, 1}, 0.55);
  vtkSmartPointer<vtkActor> scope = MakeActor({0.62, 0.66, 0.70});
  vtkSmartPointer<vtkActor> cone = MakeActor(kScopeColour, 0.7);
  vtkSmartPointer<vtkActor> probe = MakeActor({0.70, 0.70, 0.72});
  vtkSmartPointer<vtkActor> moving = MakeActor({0.70, 0.70, 0.72});
  vtkSmartPointer<vtkActor> scope_portal = MakeActor(kScopeColour, 0.5);
  vtkSmartPointer<vtkActor> instrument_portal = MakeActor(kInstrumentColour, 0.5);
  vtkSmartPointer<vtkBillboardTextActor3D> scope_label =
      MakeLabel(Overview::kLabels[0], kScopeColour);
  vtkSmartPointer<vtkBillboardTextActor3D> instrument_label =
      MakeLabel(Overview::kLabels[1], kInstrumentColour);
  std::vector<vtkSmartPointer<vtkBillboardTextActor3D>> labels;  // all of them
  double label_scale = 1;  // pixels of the picture per pixel at scale 1

  // Translucent, so that their contents are seen.
  vtkSmartPointer<vtkActor> held = MakeActor({0.35, 0.65, 0.95});
  vtkSmartPointer<vtkActor> held_chosen = MakeActor({1.0, 0.85, 0.3});

  std::vector<Ball> loose;
  std::vector<vtkSmartPointer<vtkActor>> loose_actors;  // one per loose body
  // Marks on a surface, in the frame of the tissue `marked`.
  std::vector<vtkSmartPointer<vtkActor>> marks;
  int marked = -1;
  // Arms of the handle, and the drag that began on one of them.
  Arms arms = Arms::kPortal;
  std::array<vtkSmartPointer<vtkActor>, 3> arm_actors, ring_actors;
  int dragged_arm = -1, dragged_ring = -1;
  glm::dvec3 ring_from{0.0};  // place on the ring at which the drag began
  double ring_start = 0;      // rad, of the pointer there
  glm::dvec2 drag_from{0.0};
  Pose drag_pose;

  std::vector<Model> tissues;
  // Part that has the handle instead of the chosen tissue; without an actor: none.
  Model part;
  SharedSurface part_surface;
  std::vector<Ball> balls;
  Pose balls_pose;
  bool shows_balls = false;
  int chosen_ball = -1;
  int chosen = -1;
  double radius = 0.05;
  glm::ivec2 panorama_size{0};
  bool shows_tools = true, has_tools = false, has_probe = false;
  bool changed = true;
  bool dragging = false;
  int width = 0, height = 0;

  // Object of box and handle; nullptr: nothing, or something without a surface.
  Model* Held();
  const Model* Held() const { return const_cast<Parts*>(this)->Held(); }

  void BuildScene();
  void PlaceBox();
  void PlaceArms();
  glm::dvec3 MiddleOf(const Model& model) const;          // portal frame
  glm::dvec3 AxisOf(const Model& model, int axis) const;  // unit
  glm::dvec3 ArmOf(const Model& model, int axis) const;   // from its middle to the arm's end
  std::vector<glm::dvec3> RingOf(const Model& model, int axis) const;
  void ShowRods();
  void FitShorterSide();
  void ScaleLabels(double scale);
};

}  // namespace arthro::app
