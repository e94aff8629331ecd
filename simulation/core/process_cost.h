// Processor time and memory of this process so far.
#pragma once

namespace arthro {

double ProcessCpuMs();    // user and system time of all threads
double ThreadCpuMs();     // user and system time of the calling thread
double ChildrenCpuMs();   // user and system time of the processes that it started and that ended
double PeakMemoryMb();    // largest resident size, 1e6 bytes
long ThreadPageFaults();  // pages that the calling thread got from the system

}  // namespace arthro
