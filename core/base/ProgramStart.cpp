#include "core/base/ProgramStart.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
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

}  // namespace tacto
