// OtherProgram.h - other processes: one that has a file open and does nothing else, as a program that uses a device,
// one that is run to its end, and one that is told what to do and killed.
//
// Thread-safety: the test's own thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <sys/types.h>
#include <utility>
#include <vector>

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

/// A program that drives a device until it is killed; on its input and output are words of this one. A signal that this
/// program ignores, as SIGINT under nohup, ends it all the same.
class HostProcess {
public:
    /// The program and its arguments. Throws where it does not start.
    explicit HostProcess(std::vector<std::string> words);
    ~HostProcess();
    HostProcess(const HostProcess&) = delete;
    HostProcess& operator=(const HostProcess&) = delete;

    void signal(int number) const;
    /// Waits until it has printed something, and takes one byte of it; false when it ended without.
    [[nodiscard]] bool speaks() const;
    /// The next line that it prints; nothing after 20 s, or when it has ended.
    [[nodiscard]] std::optional<std::string> readLine();
    /// False when it does not listen any more.
    bool tell(const std::string& line) const;
    /// Returns when the kernel has stopped every thread of it.
    [[nodiscard]] bool stopAndWait() const;
    /// Waits for its end; how it ended, as waitpid() says.
    [[nodiscard]] int ended();

private:
    pid_t process_ = -1;
    int in_ = -1, out_ = -1;
    std::string pending_;
};

}  // namespace tacto::test
