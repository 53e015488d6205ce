// Confinement.h - takes from this process what running a script does not need: files, network, other processes.
//
// Thread-safety: called once; it counts for all threads of the process.
#pragma once

namespace tacto {

/// From here on, system calls other than those for memory, time, locks and open files fail with EPERM (seccomp). Where
/// the kernel has no such filter nothing changes: then this process is just a process.
void confine() noexcept;

}  // namespace tacto
