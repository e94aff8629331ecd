// Makes the devices that ReleaseOnCrash holds at this moment let go, and does not wait for it: for
// a thread that learns first that the program must end, while others still have work. Does nothing
// where there are none.
#pragma once

namespace arthro::simulation {

void ReleaseDevices() noexcept;  // defined beside ReleaseOnCrash, whose devices it asks

}  // namespace arthro::simulation
