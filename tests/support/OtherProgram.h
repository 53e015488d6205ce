// OtherProgram.h - other processes: one that only keeps a file open (like a program that uses a device), one that runs
// to its end, and one that takes commands and is killed.
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

/// Runs a command line and returns its output and exit code.
[[nodiscard]] std::pair<std::string, int> outputOf(const std::string& line);

class OtherProgram {
public:
    /// If `locked`, the program also holds the file's lock (flock). Returns once the program has the file open.
    explicit OtherProgram(const std::filesystem::path& file, bool locked = false);
    ~OtherProgram();
    OtherProgram(const OtherProgram&) = delete;
    OtherProgram& operator=(const OtherProgram&) = delete;

    /// Returns the program's name as messages show it: "sleep (pid 123)".
    [[nodiscard]] std::string text() const;

private:
    pid_t process_ = -1;
    int file_ = -1;  // the same open file; its lock lasts until both processes close it
};

/// A program that drives a device until it is killed; this process writes its input and reads its output. A signal that
/// this process ignores, such as SIGINT under nohup, still ends the program.
class HostProcess {
public:
    /// `words` are the program and its arguments. Throws if the program does not start.
    explicit HostProcess(std::vector<std::string> words);
    ~HostProcess();
    HostProcess(const HostProcess&) = delete;
    HostProcess& operator=(const HostProcess&) = delete;

    void signal(int number) const;
    /// Waits until the program prints something and reads one byte of it; returns false if it ended without printing.
    [[nodiscard]] bool speaks() const;
    /// Returns the next line that the program prints; nothing after 20 s, or if the program has ended.
    [[nodiscard]] std::optional<std::string> readLine();
    /// Returns false if the program no longer reads its input.
    bool tell(const std::string& line) const;
    /// Stops the program; returns once the kernel has stopped all its threads.
    [[nodiscard]] bool stopAndWait() const;
    /// Waits for the program's end and returns its status as waitpid() gives it.
    [[nodiscard]] int ended();

private:
    pid_t process_ = -1;
    int in_ = -1, out_ = -1;
    std::string pending_;
};

}  // namespace tacto::test
