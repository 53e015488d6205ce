#include "core/base/ProgramStart.h"

#include <array>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <poll.h>
#include <pwd.h>
#include <span>
#include <unistd.h>

#include "core/base/Printable.h"

namespace tacto {

namespace {

bool namesAFolder(const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && std::filesystem::path(value).is_absolute();
}

bool homeOfTheAccount() {
    passwd account{};
    passwd* found = nullptr;
    std::array<char, 16384> text{};
    if (::getpwuid_r(::getuid(), &account, text.data(), text.size(), &found) != 0 || found == nullptr) return false;
    return std::filesystem::path(found->pw_dir).is_absolute() && ::setenv("HOME", found->pw_dir, 1) == 0;
}

}  // namespace

std::optional<std::string> refusedStart(int argc, const char* const* argv) {
    for (const char* word : std::span(argv, static_cast<std::size_t>(argc))) {
        if (isUtf8(word)) continue;
        return fmt::format(
            "the argument \"{}\" is not UTF-8; names of files are expected in UTF-8 (convmv changes them)",
            printable(word));
    }
    if (namesAFolder("HOME") || homeOfTheAccount() || namesAFolder("XDG_DATA_HOME")) return std::nullopt;
    const char* home = std::getenv("HOME");
    return fmt::format(
        "HOME is \"{}\", and the system knows no home folder of user {}; the absolute path of a folder "
        "is expected in HOME or XDG_DATA_HOME",
        printable(home != nullptr ? home : ""), ::getuid());
}

void holdStandardStreams() noexcept {
    std::signal(SIGXFSZ, SIG_IGN);
    for (;;) {
        const int file = ::open("/dev/null", O_RDWR);  // gets the lowest free number
        if (file < 0) std::_Exit(3);
        if (file <= STDERR_FILENO) continue;
        ::close(file);
        return;
    }
}

bool takesMore(int stream) noexcept {
    pollfd out{stream, POLLOUT, 0};
    return ::poll(&out, 1, 0) == 1 && (out.revents & POLLOUT) != 0;
}

std::filesystem::path dataFolder() {
    const char* data = std::getenv("XDG_DATA_HOME");
    if (const std::filesystem::path set(data != nullptr ? data : ""); set.is_absolute()) return set / "tactoscope";
    const char* home = std::getenv("HOME");
    return std::filesystem::path(home != nullptr && *home != '\0' ? home : ".") / ".local" / "share" / "tactoscope";
}

}  // namespace tacto
