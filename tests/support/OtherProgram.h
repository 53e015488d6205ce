// OtherProgram.h - other processes: one that has a file open and does nothing else, as a program that uses a device,
// and one that is run to its end.
//
// Thread-safety: the test's own thread.
#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <utility>

namespace tacto::test {

/// What a command line prints, and its exit code.
[[nodiscard]] std::pair<std::string, int> outputOf(const std::string& line);

class OtherProgram {
public:
    /// `locked`: it also holds the file's lock (flock). Returns when it has the file open.
    explicit OtherProgram(const std::filesystem::path& file, bool locked = false);
    ~OtherProgram();
    OtherProgram(const OtherProgram&) = delete;
    OtherProgram& operator=(const OtherProgram&) = delete;

    /// "sleep (pid 123)": how a message names it.
    [[nodiscard]] std::string text() const;

private:
    pid_t process_ = -1;
    int file_ = -1;  // the same open file, which keeps the lock until both have closed it
};

}  // namespace tacto::test
