// What this process has cost so far.
#pragma once

namespace arthro {

double ProcessCpuMs();  // user and system time of all threads
double ThreadCpuMs();   // of the calling thread
double PeakMemoryMb();  // largest resident size, 1e6 bytes

}  // namespace arthro
