#include "app/view/overview/overview.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vtkCamera.h>
#include <vtkEvent.h>
#include <vtkLight.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>
#include <vtkTextureObject.h>
#include <vtkTransform.h>
#include <vtkWidgetEvent.h>
#include <vtkWidgetEventTranslator.h>
#include <vtk_glew.h>

#include "app/view/instruments/probe_mesh.h"
#include "app/view/instruments/tool_mesh.h"
#include "app/view/overview/overview_impl.h"
#include "app/view/overview/overview_parts.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

const glm::dvec3 kAxisColours[3] = {{0.90, 0.35, 0.32}, {0.45, 0.80, 0.40}, {0.40, 0.58, 0.95}};
constexpr double kRodBehindPortal = 0.035;  // m, length of each rod outside the joint
constexpr double kScopeRadius = 2.0e-3;     // m, 4 mm arthroscope
constexpr double kLineRadius = 0.22e-3;
constexpr double kLabelFromPortal = 0.005;  // m, beyond its ring
constexpr double kAxisLength = 0.01;        // m; also the scale: its label says so

// Returns a flat ring around an incision, across the rod.
std::vector<std::vector<glm::dvec3>> PortalRing(const glm::dvec3& centre, double radius) {
  std::vector<std::vector<glm::dvec3>> ring(1);
  for (int i = 0; i <= 48; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 48;
    ring[0].push_back(centre + radius * glm::dvec3(std::cos(a), std::sin(a), 0.0));
  }
  return ring;
}

}  // namespace

// The whole scene is in view for either aspect ratio; a narrow picture keeps room for the labels.
void Overview::Parts::FitShorterSide() {
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetUseHorizontalViewAngle(width < height);
  camera->SetViewAngle(width < height ? 39.0 : 32.0);
}

void Overview::Parts::ScaleLabels(double scale) {
  if (scale == label_scale) return;
  label_scale = scale;
  for (const auto& label : labels)
    label->GetTextProperty()->SetFontSize(static_cast<int>(std::lround(kLabelSize * scale)));
  changed = true;
}

void Overview::Parts::BuildScene() {
  window->AddRenderer(renderer);
  window->SetSize(16, 16);
  renderer->SetBackground(0.10, 0.11, 0.13);
  renderer->SetBackground2(0.20, 0.22, 0.25);
  renderer->GradientBackgroundOn();
  renderer->SetBackgroundAlpha(1.0);
  // A light beside the eye and a weaker one from below, so that shapes are visible from all sides.
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

  // The bowl can be viewed from any side: only its inside is drawn.
  relief->GetProperty()->BackfaceCullingOn();
  relief->VisibilityOff();
  for (vtkActor* metal : {scope.Get(), probe.Get(), moving.Get()}) {
    metal->GetProperty()->SetSpecular(0.5);
    metal->GetProperty()->SetSpecularPower(30);
    metal->VisibilityOff();
  }
  cone->VisibilityOff();
  SetData(*scope_portal, MakeBars(PortalRing({0, 0, 0}, 3.2e-3), 0.6e-3));
  for (vtkActor* actor : {relief.Get(), scope.Get(), cone.Get(), probe.Get(), moving.Get(),
                          scope_portal.Get(), instrument_portal.Get()})
    renderer->AddActor(actor);
  for (vtkActor* balls_of : {held.Get(), held_chosen.Get()}) {
    balls_of->ForceOpaqueOff();
    balls_of->ForceTranslucentOn();
    balls_of->GetProperty()->BackfaceCullingOn();  // less hides what is in them
    balls_of->VisibilityOff();
    renderer->AddActor(balls_of);
  }
  renderer->AddActor(scope_label);
  renderer->AddActor(instrument_label);
  labels = {scope_label, instrument_label};

  // Axes of the portal frame, below everything.
  const glm::dvec3 origin{-0.016, 0.034, 0.0};
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 end = origin;
    end[i] += kAxisLength;
    auto axis = MakeActor(kAxisColours[i], 0.6);
    SetData(*axis, MakeBars({{origin, end}}, 2 * kLineRadius));
    auto label = MakeLabel(Overview::kLabels[2 + static_cast<std::size_t>(i)], kAxisColours[i]);
    label->SetPosition(end.x, end.y, end.z);
    // Away from the other two.
    vtkTextProperty* text = label->GetTextProperty();
    if (i == 0) text->SetVerticalJustificationToCentered();
    if (i == 1) text->SetVerticalJustificationToTop();
    if (i > 0) text->SetJustificationToCentered();
    renderer->AddActor(axis);
    renderer->AddActor(label);
    labels.push_back(label);
  }
}

void Overview::SetLabels(const std::array<std::string, kLabels.size()>& words) {
  for (std::size_t i = 0; i < words.size(); ++i) parts_->labels[i]->SetInput(words[i].c_str());
  parts_->changed = true;
}

Overview::Overview() : parts_(std::make_unique<Parts>()) {
  Parts& p = *parts_;
  p.BuildScene();
  SetIncisionSpacing(Portals().incision_spacing);

  p.interactor->SetRenderWindow(p.window);
  p.interactor->EnableRenderOff();  // only Render draws
  p.interactor->SetInteractorStyle(p.style);
  p.style->SetDefaultRenderer(p.renderer);
  p.asked_to_draw->SetClientData(&p);
  p.asked_to_draw->SetCallback([](vtkObject*, unsigned long, void* data, void*) {
    static_cast<Parts*>(data)->changed = true;
  });
  p.interactor->AddObserver(vtkCommand::RenderEvent, p.asked_to_draw);

  p.box_look->SetPlaceFactor(1.0);
  p.box_look->HandlesOff();  // they move faces, and hide small tissue
  p.box_look->GetOutlineProperty()->SetColor(1.0, 0.85, 0.3);
  p.box_look->GetSelectedOutlineProperty()->SetColor(1.0, 1.0, 0.6);
  p.box->SetRepresentation(p.box_look);
  p.box->SetInteractor(p.interactor);
  p.box->MoveFacesEnabledOff();  // a pose has one scale for all directions
  // VTK's own left drag turns; here it moves, the most frequent operation.
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
    if (parts.Held() == nullptr) return;
    vtkNew<vtkTransform> transform;
    parts.box_look->GetTransform(transform);
    auto& model = *parts.Held();
    model.pose = PoseOf(*transform->GetMatrix());
    model.actor->SetUserMatrix(MatrixOf(model.pose));
    parts.changed = true;
    const bool is_finished = event == vtkCommand::EndInteractionEvent;
    if (parts.part.actor) {
      if (overview.on_part) overview.on_part(model.pose, is_finished);
    } else if (overview.on_pose) {
      overview.on_pose(parts.chosen, model.pose, is_finished);
    }
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
  SetData(*p.relief, MakeReliefMesh(p.panorama_size, depth, backdrop));
  p.radius = backdrop.radius;
  p.changed = true;
}

void Overview::SetIncisionSpacing(double spacing) {
  Parts& p = *parts_;
  SetData(*p.instrument_portal, MakeBars(PortalRing({spacing, 0, 0}, 3.2e-3), 0.6e-3));
  // Each label begins over its own ring and extends away from the other, since they may be close.
  const double side = spacing < 0 ? -1.0 : 1.0;
  p.scope_label->SetPosition(2e-3 * side, -kLabelFromPortal, 0.0);
  p.instrument_label->SetPosition(spacing - 2e-3 * side, -kLabelFromPortal, 0.0);
  for (auto* label : {p.scope_label.Get(), p.instrument_label.Get()}) {
    const bool is_on_the_right = (label == p.instrument_label.Get()) == (side > 0);
    is_on_the_right ? label->GetTextProperty()->SetJustificationToLeft()
                    : label->GetTextProperty()->SetJustificationToRight();
  }
  p.changed = true;
}

void Overview::SetTools(const OverviewTools& tools) {
  Parts& p = *parts_;
  const glm::dvec3& tip = tools.scope.tip;
  // The scope's rod passes through the origin; a mark at the portal shows its direction of view.
  const glm::dvec3 along =
      glm::length(tip) > 1e-6 ? glm::normalize(tip) : glm::dvec3(0.0, 0.0, 1.0);
  SetData(*p.scope, MakeBars({{-kRodBehindPortal * along, tip}}, kScopeRadius, 20));
  SetData(*p.cone,
          MakeBars(ViewConeLines(tools.scope, tools.field_of_view, p.radius), kLineRadius, 6));
  p.has_tools = true;

  const double inside =
      tools.instrument ? glm::distance(tools.instrument->proxy, tools.instrument->portal) : 0.0;
  p.has_probe = inside > 1e-6;
  p.ShowRods();
  if (p.has_probe) {
    const InstrumentView& instrument = *tools.instrument;
    // No lens bends it here, so rings may be sparse.
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

void Overview::Parts::ShowRods() {
  for (vtkActor* of_scope : {scope.Get(), cone.Get()})
    of_scope->SetVisibility(shows_tools && has_tools ? 1 : 0);
  for (vtkActor* of_probe : {probe.Get(), moving.Get()})
    of_probe->SetVisibility(shows_tools && has_probe ? 1 : 0);
  for (vtkActor* portal : {scope_portal.Get(), instrument_portal.Get()})
    portal->SetVisibility(shows_tools ? 1 : 0);
  for (const auto& label : labels) label->SetVisibility(shows_tools ? 1 : 0);
}

void Overview::ShowTools(bool is_shown) {
  if (parts_->shows_tools == is_shown) return;
  parts_->shows_tools = is_shown;
  parts_->ShowRods();
  parts_->changed = true;
}

void Overview::Handle(const PointerEvent& event) {
  Parts& p = *parts_;
  p.interactor->SetEventInformationFlipY(static_cast<int>(event.x), static_cast<int>(event.y),
                                         event.control ? 1 : 0, event.shift ? 1 : 0);
  using Kind = PointerEvent::Kind;
  using Button = PointerEvent::Button;
  if (event.kind == Kind::kMove) {
    if (p.dragged_arm >= 0) {
      DragArm(event);
      return;
    }
    if (p.dragged_ring >= 0) {
      DragRing(event);
      return;
    }
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
  if (DragArm(event)) return;
  // Only a drag that begins on the handle is the box's; every other one is the view's.
  if (press) {
    const auto handle = HandlePlace();
    const bool is_on_handle =
        handle && glm::distance(*handle, {event.x, event.y}) <= kHandleRadius * handle_scale;
    if (!is_on_handle && DragRing(event)) return;
    p.box->SetProcessEvents(is_on_handle ? 1 : 0);
  } else if (DragRing(event)) {
    return;
  }
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

void Overview::LookFrom(Side side) {
  Parts& p = *parts_;
  const double r = p.radius;
  constexpr double kAway = 3.3;  // in radii, as far as the oblique view
  vtkCamera* camera = p.renderer->GetActiveCamera();
  camera->SetFocalPoint(0.0, 0.06 * r, 0.45 * r);
  camera->SetViewUp(0.0, -1.0, 0.0);
  switch (side) {
    case Side::kWhole:  // from behind the operator's right shoulder, into the bowl
      camera->SetPosition(1.3 * r, -1.55 * r, -2.15 * r);
      break;
    case Side::kFront:
      camera->SetPosition(0.0, 0.06 * r, (0.45 - kAway) * r);
      break;
    case Side::kTop:
      camera->SetPosition(0.0, (0.06 - kAway) * r, 0.45 * r);
      camera->SetViewUp(0.0, 0.0, 1.0);
      break;
    case Side::kRight:
      camera->SetPosition(kAway * r, 0.06 * r, 0.45 * r);
      break;
  }
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
    p.interactor->UpdateSize(width, height);  // picking uses this size, not the window's
    p.FitShorterSide();
    p.changed = true;
  }
  p.ScaleLabels(handle_scale);
  if (!p.changed) return false;
  p.changed = false;
  p.window->GetState()->Reset();  // other code has drawn in this context
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
