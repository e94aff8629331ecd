// Options of a practice session: backdrop, contact, lever, and limits of the devices.
#pragma once

#include "simulation/haptics/contact.h"
#include "simulation/haptics/output/force_limiter.h"
#include "simulation/haptics/output/lever.h"
#include "simulation/haptics/output/passivity.h"
#include "simulation/haptics/output/thermal.h"
#include "simulation/haptics/relief/depth_field.h"
#include "simulation/tissue/body/body_options.h"

namespace arthro::simulation {

struct SessionOptions {
  DepthFieldOptions depth;
  ContactOptions contact;
  LeverOptions lever;
  PassivityOptions passivity;
  ThermalOptions thermal;
  LimiterOptions limiter;
  BodyOptions tissue;  // its tool spring is replaced by contact.stiffness
  template <class V>
  void Visit(V&& v) {
    depth.Visit(v);
    contact.Visit(v);
    lever.Visit(v);
    passivity.Visit(v);
    thermal.Visit(v);
    limiter.Visit(v);
    tissue.Visit(v);
  }
};

}  // namespace arthro::simulation
