// StandardStreams.h - stdin, stdout and stderr are open in every program of ours: where one is closed, the next file
// that is opened takes its number, and what is printed for the user would be written into a device (hazard H4).
//
// Thread-safety: once, first in main().
#pragma once

namespace tacto {

/// Opens /dev/null for those of the three that are closed. Ends the program when that cannot be done.
void holdStandardStreams() noexcept;

}  // namespace tacto
