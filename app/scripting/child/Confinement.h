// Confinement.h - takes files, network and other processes away from this process: a script needs none of them.
//
// Thread-safety: called once; takes effect for all threads of the process.
#pragma once

namespace tacto {

/// From here on, system calls other than those for memory, time, locks and open files fail with EPERM (seccomp). If the
/// kernel has no such filter, this function changes nothing.
void confine() noexcept;

}  // namespace tacto
