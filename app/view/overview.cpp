#include "app/view/overview.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <vtkBoxRepresentation.h>
#include <vtkBoxWidget2.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkEvent.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTextureObject.h>
#include <vtkTransform.h>
#include <vtkWidgetEvent.h>
#include <vtkWidgetEventTranslator.h>
#include <vtk_glew.h>

#include "app/view/context_render_window.h"
#include "app/view/overview_parts.h"
#include "app/view/probe_mesh.h"
#include "app/view/srgb.h"
#include "app/view/tool_mesh.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

const glm::dvec3 kScopeColour{0.25, 0.75, 0.80}, kInstrumentColour{0.95, 0.68, 0.25};
const glm::dvec3 kAxisColours[3] = {{0.90, 0.35, 0.32}, {0.45, 0.80, 0.40}, {0.40, 0.58, 0.95}};
const glm::dvec3 kFreshColour{0.97, 0.93, 0.84};  // of a cut face: the inside of a tissue is paler
constexpr double kRodBehindPortal = 0.035;        // of each rod, drawn outside the joint, m
constexpr double kScopeRadius = 2.0e-3;           // of a 4 mm arthroscope
constexpr double kLineRadius = 0.22e-3;
constexpr double kAxisLength = 0.01;  // also the scale: its label says so

vtkSmartPointer<vtkMatrix4x4> MatrixOf(const Pose& pose) {
  const glm::dmat3 rotation = glm::mat3_cast(pose.quaternion);
  auto matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) matrix->SetElement(r, c, pose.scale * rotation[c][r]);
    matrix->SetElement(r, 3, pose.position[r]);
  }
  return matrix;
}

Pose PoseOf(const vtkMatrix4x4& matrix) {
  glm::dmat3 linear;
  Pose pose;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) linear[c][r] = matrix.GetElement(r, c);
    pose.position[r] = matrix.GetElement(r, 3);
  }
  pose.scale = std::cbrt(glm::determinant(linear));
  // The box keeps its angles but for rounding.
  const glm::dvec3 x = glm::normalize(linear[0]);
  const glm::dvec3 y = glm::normalize(linear[1] - glm::dot(linear[1], x) * x);
  pose.quaternion = glm::normalize(glm::quat_cast(glm::dmat3(x, y, glm::cross(x, y))));
  return pose;
}

// A flat-lying ring about an incision, across the rod.
std::vector<std::vector<glm::dvec3>> PortalRing(const glm::dvec3& centre, double radius) {
  std::vector<std::vector<glm::dvec3>> ring(1);
  for (int i = 0; i <= 48; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 48;
    ring[0].push_back(centre + radius * glm::dvec3(std::cos(a), std::sin(a), 0.0));
  }
  return ring;
}

}  // namespace

struct Overview::Parts {
  struct Model {
    vtkSmartPointer<vtkActor> actor;
    vtkSmartPointer<vtkPolyData> data;
    SurfaceMesh surface;
    Pose pose;
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
  vtkSmartPointer<vtkBillboardTextActor3D> scope_label = MakeLabel("scope portal", kScopeColour);
  vtkSmartPointer<vtkBillboardTextActor3D> instrument_label =
      MakeLabel("instrument portal", kInstrumentColour);

  // Translucent: what they hold is seen through them.
  vtkSmartPointer<vtkActor> held = MakeActor({0.35, 0.65, 0.95});
  vtkSmartPointer<vtkActor> held_chosen = MakeActor({1.0, 0.85, 0.3});

  std::vector<Model> tissues;
  std::vector<Ball> balls;
  Pose balls_pose;
  bool shows_balls = false;
  int chosen_ball = -1;
  int chosen = -1;
  double radius = 0.05;
  glm::ivec2 panorama_size{0};
  bool changed = true;
  bool dragging = false;
  int width = 0, height = 0;

  void BuildScene();
  void PlaceBox();
  void FitShorterSide();
};

// The whole scene is seen whichever side is shorter; a narrow picture keeps room for the labels.
void Overview::Parts::FitShorterSide() {
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetUseHorizontalViewAngle(width < height);
  camera->SetViewAngle(width < height ? 39.0 : 32.0);
}

void Overview::Parts::BuildScene() {
  window->AddRenderer(renderer);
  window->SetSize(16, 16);
  renderer->SetBackground(0.10, 0.11, 0.13);
  renderer->SetBackground2(0.20, 0.22, 0.25);
  renderer->GradientBackgroundOn();
  renderer->SetBackgroundAlpha(1.0);
  // A lamp beside the eye and a weaker one from below, so that shapes read from all sides.
  renderer->AutomaticLightCreationOff();
  vtkNew<vtkLight> key, fill;
  key->SetLightTypeToCameraLight();
  key->SetPosition(-0.4, 0.6, 1.0);
  key->SetIntensity(0.9);
  fill->SetLightTypeToCameraLight();
  fill->SetPosition(0.6, -0.5, 0.6);
  fill->SetIntensity(0.35);
  renderer->AddLight(key);
  renderer->AddLight(fill);

  // The bowl is looked into from any side: only its inside is drawn.
  relief->GetProperty()->BackfaceCullingOn();
  relief->VisibilityOff();
  for (vtkActor* metal : {scope.Get(), probe.Get(), moving.Get()}) {
    metal->GetProperty()->SetSpecular(0.5);
    metal->GetProperty()->SetSpecularPower(30);
    metal->VisibilityOff();
  }
  cone->VisibilityOff();
  SetData(*scope_portal, MakeBars(PortalRing({0, 0, 0}, 3.2e-3), 0.6e-3));
  scope_label->SetPosition(-0.002, -0.005, 0.0);
  for (vtkActor* actor : {relief.Get(), scope.Get(), cone.Get(), probe.Get(), moving.Get(),
                          scope_portal.Get(), instrument_portal.Get()})
    renderer->AddActor(actor);
  for (vtkActor* balls_of : {held.Get(), held_chosen.Get()}) {
    balls_of->ForceOpaqueOff();
    balls_of->ForceTranslucentOn();
    balls_of->GetProperty()->SetOpacity(0.45);
    balls_of->VisibilityOff();
    renderer->AddActor(balls_of);
  }
  renderer->AddActor(scope_label);
  renderer->AddActor(instrument_label);

  // The portal frame's axes, below everything.
  const glm::dvec3 origin{-0.006, 0.032, 0.0};
  const char* names[3] = {"x right", "y down", "z in"};
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 end = origin;
    end[i] += kAxisLength;
    auto axis = MakeActor(kAxisColours[i], 0.6);
    SetData(*axis, MakeBars({{origin, end}}, 2 * kLineRadius));
    auto label = MakeLabel(names[i], kAxisColours[i]);
    label->SetPosition(end.x, end.y, end.z);
    renderer->AddActor(axis);
    renderer->AddActor(label);
  }
}

void Overview::Parts::PlaceBox() {
  const bool shown = chosen >= 0 && !tissues[std::size_t(chosen)].surface.triangles.empty();
  if (!shown) {
    box->Off();
    return;
  }
  // The box is that of the resting surface in its own frame; its transform is the pose.
  Model& model = tissues[std::size_t(chosen)];
  double bounds[6];
  model.data->GetBounds(bounds);
  box_look->PlaceWidget(bounds);
  vtkNew<vtkTransform> transform;
  transform->SetMatrix(MatrixOf(model.pose));
  box_look->SetTransform(transform);
  box->On();
}

Overview::Overview() : parts_(std::make_unique<Parts>()) {
  Parts& p = *parts_;
  p.BuildScene();
  SetIncisionSpacing(Portals().incision_spacing);

  p.interactor->SetRenderWindow(p.window);
  p.interactor->EnableRenderOff();  // drawn by Render alone
  p.interactor->SetInteractorStyle(p.style);
  p.style->SetDefaultRenderer(p.renderer);
  p.asked_to_draw->SetClientData(&p);
  p.asked_to_draw->SetCallback([](vtkObject*, unsigned long, void* data, void*) {
    static_cast<Parts*>(data)->changed = true;
  });
  p.interactor->AddObserver(vtkCommand::RenderEvent, p.asked_to_draw);

  p.box_look->SetPlaceFactor(1.0);
  p.box_look->HandlesOff();  // they are for moving faces, and hide small tissue
  p.box_look->GetOutlineProperty()->SetColor(1.0, 0.85, 0.3);
  p.box_look->GetSelectedOutlineProperty()->SetColor(1.0, 1.0, 0.6);
  p.box->SetRepresentation(p.box_look);
  p.box->SetInteractor(p.interactor);
  p.box->MoveFacesEnabledOff();  // a pose has one scale for all directions
  // VTK's own left drag turns; moving is what is done most.
  vtkWidgetEventTranslator* events = p.box->GetEventTranslator();
  events->RemoveTranslation(vtkCommand::LeftButtonPressEvent);
  const auto on_press = [&](unsigned long button, int modifier, unsigned long what) {
    events->SetTranslation(button, modifier, 0, 0, nullptr, what);
  };
  on_press(vtkCommand::LeftButtonPressEvent, vtkEvent::NoModifier, vtkWidgetEvent::Translate);
  on_press(vtkCommand::LeftButtonPressEvent, vtkEvent::ShiftModifier, vtkWidgetEvent::Select);
  on_press(vtkCommand::LeftButtonPressEvent, vtkEvent::ControlModifier, vtkWidgetEvent::Select);
  p.box_moved->SetClientData(this);
  p.box_moved->SetCallback([](vtkObject*, unsigned long event, void* data, void*) {
    auto& overview = *static_cast<Overview*>(data);
    Parts& parts = *overview.parts_;
    if (parts.chosen < 0) return;
    vtkNew<vtkTransform> transform;
    parts.box_look->GetTransform(transform);
    auto& model = parts.tissues[std::size_t(parts.chosen)];
    model.pose = PoseOf(*transform->GetMatrix());
    model.actor->SetUserMatrix(MatrixOf(model.pose));
    parts.changed = true;
    if (overview.on_pose)
      overview.on_pose(parts.chosen, model.pose, event == vtkCommand::EndInteractionEvent);
  });
  p.box->AddObserver(vtkCommand::InteractionEvent, p.box_moved);
  p.box->AddObserver(vtkCommand::EndInteractionEvent, p.box_moved);

  p.window->Render();  // initialises OpenGL
  if (!p.window->IsReady())
    throw Error(Code::kDisplay,
                "the overview needs OpenGL 3.2; update the graphics driver or run with "
                "LIBGL_ALWAYS_SOFTWARE=1");
  p.interactor->Initialize();
  ResetCamera();
}

Overview::~Overview() {
  parts_->box->Off();
  parts_->box->SetInteractor(nullptr);
  parts_->window->Finalize();
}

void Overview::SetBackdrop(const ColourImage& panorama, const DepthMap& depth,
                           const Backdrop& backdrop) {
  Parts& p = *parts_;
  p.panorama_size = {panorama.width, panorama.height};
  p.relief->SetTexture(MakePanoramaTexture(panorama));
  p.relief->VisibilityOn();
  SetRelief(depth, backdrop);
}

void Overview::SetRelief(const DepthMap& depth, const Backdrop& backdrop) {
  Parts& p = *parts_;
  SetData(*p.relief, MakeReliefMesh(p.panorama_size.x, p.panorama_size.y, depth, backdrop));
  p.radius = backdrop.radius;
  p.changed = true;
}

void Overview::SetTissues(std::span<const Tissue> tissues, std::span<const SurfaceMesh> surfaces) {
  Parts& p = *parts_;
  for (const auto& model : p.tissues) p.renderer->RemoveActor(model.actor);
  p.tissues.clear();
  for (std::size_t i = 0; i < tissues.size(); ++i) {
    Parts::Model model;
    if (i < surfaces.size()) model.surface = surfaces[i];
    model.pose = tissues[i].pose;
    model.data = MakeSurfaceData(model.surface);
    const glm::dvec3& c = tissues[i].colour;
    // A little darker than in the joint, where light falls on it from the front only.
    model.actor =
        MakeActor(0.9 * glm::dvec3(SrgbFromLinear(c.x), SrgbFromLinear(c.y), SrgbFromLinear(c.z)));
    model.actor->GetProperty()->SetSpecular(0.06);
    model.actor->GetProperty()->SetSpecularPower(25);
    SetData(*model.actor, model.data);
    model.actor->SetUserMatrix(MatrixOf(model.pose));
    p.renderer->AddActor(model.actor);
    p.tissues.push_back(std::move(model));
  }
  if (p.chosen >= static_cast<int>(p.tissues.size())) p.chosen = -1;
  p.PlaceBox();
  p.changed = true;
}

void Overview::SetTissuePose(int index, const Pose& portal_from_tissue) {
  Parts& p = *parts_;
  auto& model = p.tissues.at(static_cast<std::size_t>(index));
  model.pose = portal_from_tissue;
  model.actor->SetUserMatrix(MatrixOf(model.pose));
  // The box under the pointer keeps to the pointer.
  if (index == p.chosen && !p.dragging) p.PlaceBox();
  p.changed = true;
}

bool Overview::SetTissueShape(int index, std::span<const glm::dvec3> positions,
                              std::span<const glm::dvec3> normals) {
  auto& model = parts_->tissues.at(static_cast<std::size_t>(index));
  if (positions.size() != model.surface.vertices.size() ||
      (!normals.empty() && normals.size() != positions.size()))
    throw Error(Code::kBadArgument,
                fmt::format("tissue {} was given {} vertices to draw; its "
                            "surface has {}",
                            index, positions.size(), model.surface.vertices.size()));
  if (std::equal(positions.begin(), positions.end(), model.surface.vertices.begin())) return false;
  model.surface.vertices.assign(positions.begin(), positions.end());
  MoveSurfaceData(*model.data, model.surface, normals);
  parts_->changed = true;
  return true;
}

void Overview::SetTissueSurface(int index, const SurfaceMesh& surface,
                                std::span<const std::uint8_t> fresh) {
  auto& model = parts_->tissues.at(static_cast<std::size_t>(index));
  model.surface = surface;
  model.data = MakeSurfaceData(surface);
  double own[3];
  model.actor->GetProperty()->GetColor(own);
  ColourVertices(*model.data, {own[0], own[1], own[2]}, kFreshColour, fresh);
  SetData(*model.actor, model.data);
  parts_->changed = true;
}

void Overview::SetIncisionSpacing(double spacing) {
  Parts& p = *parts_;
  SetData(*p.instrument_portal, MakeBars(PortalRing({spacing, 0, 0}, 3.2e-3), 0.6e-3));
  p.instrument_label->SetPosition(spacing - 0.002, -0.005, 0.0);
  p.changed = true;
}

void Overview::SetTools(const OverviewTools& tools) {
  Parts& p = *parts_;
  const glm::dvec3& tip = tools.scope.tip;
  // The scope's rod runs through the origin; at the portal itself it shows the way it looks.
  const glm::dvec3 along =
      glm::length(tip) > 1e-6 ? glm::normalize(tip) : glm::dvec3(0.0, 0.0, 1.0);
  SetData(*p.scope, MakeBars({{-kRodBehindPortal * along, tip}}, kScopeRadius, 20));
  SetData(*p.cone,
          MakeBars(ViewConeLines(tools.scope, tools.field_of_view, p.radius), kLineRadius, 6));
  p.scope->VisibilityOn();
  p.cone->VisibilityOn();

  const double inside =
      tools.instrument ? glm::distance(tools.instrument->proxy, tools.instrument->portal) : 0.0;
  p.probe->SetVisibility(inside > 1e-6 ? 1 : 0);
  p.moving->SetVisibility(inside > 1e-6 ? 1 : 0);
  if (inside > 1e-6) {
    const InstrumentView& instrument = *tools.instrument;
    // No lens bends it here, so rings may lie far apart.
    const ToolMesh tool = MakeToolMesh(instrument.kind, 4e-3, inside + kRodBehindPortal);
    SetData(*p.probe, MakeSurfaceData(tool.body));
    SetData(*p.moving, MakeSurfaceData(tool.moving));
    const Pose pose = ProbePose(instrument.portal, instrument.proxy, instrument.roll);
    const Pose part = MovingPart(tool, instrument.opening, instrument.turn);
    p.probe->SetUserMatrix(MatrixOf(pose));
    p.moving->SetUserMatrix(
        MatrixOf({pose * part.position, pose.quaternion * part.quaternion, 1.0}));
  }
  p.changed = true;
}

void Overview::ChooseTissue(int index) {
  Parts& p = *parts_;
  if (index >= static_cast<int>(p.tissues.size())) index = -1;
  if (index == p.chosen) return;
  p.chosen = index;
  p.PlaceBox();
  p.changed = true;
}

void Overview::ShowBalls(int tissue, std::span<const Ball> balls, int chosen) {
  Parts& p = *parts_;
  if (tissue >= static_cast<int>(p.tissues.size())) tissue = -1;
  const bool is_shown = tissue >= 0 && !balls.empty();
  const Pose pose = is_shown ? p.tissues[std::size_t(tissue)].pose : Pose{};
  const bool is_same = is_shown == p.shows_balls && chosen == p.chosen_ball &&
                       std::equal(balls.begin(), balls.end(), p.balls.begin(), p.balls.end()) &&
                       pose.position == p.balls_pose.position &&
                       pose.quaternion == p.balls_pose.quaternion &&
                       pose.scale == p.balls_pose.scale;
  if (is_same) return;
  p.shows_balls = is_shown;
  p.chosen_ball = chosen;
  p.balls.assign(balls.begin(), balls.end());
  p.balls_pose = pose;
  std::vector<Ball> others, lit;
  for (std::size_t i = 0; i < balls.size(); ++i)
    (static_cast<int>(i) == chosen ? lit : others).push_back(balls[i]);
  for (const auto& [actor, some] :
       {std::pair{p.held.Get(), &others}, {p.held_chosen.Get(), &lit}}) {
    SetData(*actor, MakeSurfaceData(MakeBalls(*some)));
    actor->SetUserMatrix(MatrixOf(pose));
    actor->SetVisibility(is_shown && !some->empty() ? 1 : 0);
  }
  p.changed = true;
}

std::optional<Overview::TissuePlace> Overview::PickTissue(double x, double y) const {
  const Parts& p = *parts_;
  glm::dvec3 ends[2];
  for (int i = 0; i < 2; ++i) {
    double world[4];
    p.renderer->SetDisplayPoint(x, p.height - 1 - y, i);
    p.renderer->DisplayToWorld();
    p.renderer->GetWorldPoint(world);
    ends[i] = glm::dvec3(world[0], world[1], world[2]) / world[3];
  }
  std::optional<TissuePlace> place;
  double nearest = 1.0;  // share of the way between the ends
  for (std::size_t i = 0; i < p.tissues.size(); ++i) {
    const Pose& pose = p.tissues[i].pose;
    const auto own = [&](const glm::dvec3& world) {
      return (glm::conjugate(pose.quaternion) * (world - pose.position)) / pose.scale;
    };
    const glm::dvec3 from = own(ends[0]), way = own(ends[1]) - from;
    if (const auto share = FirstHit(p.tissues[i].surface, from, way); share && *share < nearest) {
      nearest = *share;
      place = TissuePlace{static_cast<int>(i), from + *share * way};
    }
  }
  return place;
}

void Overview::Handle(const PointerEvent& event) {
  Parts& p = *parts_;
  p.interactor->SetEventInformationFlipY(static_cast<int>(event.x), static_cast<int>(event.y),
                                         event.control ? 1 : 0, event.shift ? 1 : 0);
  using Kind = PointerEvent::Kind;
  using Button = PointerEvent::Button;
  if (event.kind == Kind::kMove) {
    p.interactor->InvokeEvent(vtkCommand::MouseMoveEvent);
    return;
  }
  if (event.kind == Kind::kWheel) {
    for (int i = 0; i < std::abs(static_cast<int>(std::lround(event.wheel))); ++i)
      p.interactor->InvokeEvent(event.wheel > 0 ? vtkCommand::MouseWheelForwardEvent
                                                : vtkCommand::MouseWheelBackwardEvent);
    return;
  }
  const bool press = event.kind == Kind::kPress;
  p.dragging = press;
  if (event.button == Button::kLeft)
    p.interactor->InvokeEvent(press ? vtkCommand::LeftButtonPressEvent
                                    : vtkCommand::LeftButtonReleaseEvent);
  else if (event.button == Button::kMiddle)
    p.interactor->InvokeEvent(press ? vtkCommand::MiddleButtonPressEvent
                                    : vtkCommand::MiddleButtonReleaseEvent);
  else
    p.interactor->InvokeEvent(press ? vtkCommand::RightButtonPressEvent
                                    : vtkCommand::RightButtonReleaseEvent);
}

void Overview::ResetCamera() {
  Parts& p = *parts_;
  // From behind the operator's right shoulder, into the bowl.
  const double r = p.radius;
  vtkCamera* camera = p.renderer->GetActiveCamera();
  camera->SetFocalPoint(0.0, 0.06 * r, 0.45 * r);
  camera->SetPosition(1.3 * r, -1.55 * r, -2.15 * r);
  camera->SetViewUp(0.0, -1.0, 0.0);
  p.FitShorterSide();
  p.changed = true;
}

bool Overview::Render(int width, int height) {
  Parts& p = *parts_;
  width = std::max(width, 1);
  height = std::max(height, 1);
  if (width != p.width || height != p.height) {
    p.width = width;
    p.height = height;
    p.window->SetSize(width, height);
    p.interactor->UpdateSize(width, height);  // picking is by its size, not the window's
    p.FitShorterSide();
    p.changed = true;
  }
  if (!p.changed) return false;
  p.changed = false;
  p.window->GetState()->Reset();  // others have drawn in this context
  p.renderer->ResetCameraClippingRange();
  p.window->Render();
  p.changed = false;
  return true;
}

unsigned int Overview::TextureId() const {
  return parts_->window->GetRenderFramebuffer()->GetColorAttachmentAsTextureObject(0)->GetHandle();
}

ColourImage Overview::ReadPixels() const { return parts_->window->ReadPicture(); }

}  // namespace arthro::app
