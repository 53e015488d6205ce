// PythonEnvironment.h - a Python with packages from PyPI, made once beside the build: other programs' readers and
// writers, as oracles of our files. Without a network there is none, and the test is skipped by name.
//
// Thread-safety: several programs may ask at once; one makes it while the others wait.
#pragma once

#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <optional>
#include <string>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tacto::test {

struct ProgramOutput {
    int code = -1;
    std::string text;  ///< stdout and stderr
};
inline ProgramOutput outputOfShell(const std::string& command) {
    ProgramOutput output;
    std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    if (pipe == nullptr) return output;
    char piece[4096];
    while (const auto got = std::fread(piece, 1, sizeof piece, pipe)) output.text.append(piece, got);
    const int ended = pclose(pipe);
    output.code = WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
    return output;
}

inline constexpr const char* kNoPackages = "its Python packages are not here and cannot be installed: skipped";

/// Returns the path of a Python in the environment `name` in which `imports` ("h5py, xarray") succeeds after
/// `packages` ("h5py xarray") were installed; nothing if they cannot be.
inline std::optional<std::string> pythonWith(const std::string& name, const std::string& imports,
                                             const std::string& packages) {
    std::error_code none;
    const auto build = std::filesystem::read_symlink("/proc/self/exe", none).parent_path().parent_path();
    const auto folder = (build / ("python-" + name)).string();
    const auto python = folder + "/bin/python";
    const int lock = ::open((folder + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (lock >= 0) ::flock(lock, LOCK_EX);
    const auto works = [&] { return outputOfShell("'" + python + "' -c 'import " + imports + "'").code == 0; };
    bool there = works();
    if (!there) {
        static_cast<void>(outputOfShell("python3 -m venv '" + folder + "' && '" + python +
                                        "' -m pip install --quiet --timeout 10 --retries 1 " + packages));
        there = works();
    }
    if (lock >= 0) ::close(lock);
    return there ? std::optional(python) : std::nullopt;
}

}  // namespace tacto::test
