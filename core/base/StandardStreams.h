// StandardStreams.h - stdin, stdout and stderr are open in every program of ours: where one is closed, the next file
// that is opened takes its number, and what is printed for the user would be written into a device (hazard H4).
//
// A limit on the size of files is an error of what writes, as a full disk is, and does not end the program.
//
// Thread-safety: holdStandardStreams() once, first in main(); takesMore() from any thread.
#pragma once

namespace tacto {

/// Opens /dev/null for those of the three that are closed, and ignores SIGXFSZ. Ends the program when /dev/null cannot
/// be opened.
void holdStandardStreams() noexcept;

/// Whether a line can be written to `stream` at once: writing into a pipe that is full holds the thread that writes,
/// and with it a stop.
[[nodiscard]] bool takesMore(int stream) noexcept;

}  // namespace tacto
