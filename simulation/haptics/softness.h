// What of the rigid surfaces gives way by a law of its own, as a layer of cartilage on bone does:
// the surface stays the proxy's, and the tool goes into it behind the proxy. Whoever knows the law
// implements this; noexcept, allocates nothing. m, N.
#pragma once

namespace arthro::simulation {

class Softness {
 public:
  virtual ~Softness() = default;
  // How deep surface `contact` lets a tip go that a spring of `stiffness` (N/m) pulls to `depth`
  // below it: δ of F(δ) = stiffness (depth − δ), within 0 and `depth`. 0: it is rigid.
  virtual double Sink(int contact, double depth, double stiffness) const noexcept = 0;
};

}  // namespace arthro::simulation
