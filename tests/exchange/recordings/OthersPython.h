// OthersPython.h - a Python with others' readers of these formats.
//
// Thread-safety: the test's own thread; programs wait for each other.
#pragma once

#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <string>

#include "tests/support/OtherProgram.h"

namespace tacto::test {

inline constexpr const char* kNoReaders = "no pyxdf, pyEDFlib and edfio: PyPI cannot be reached";

/// Returns the command of such a Python, installed once beside the build; nothing without network.
[[nodiscard]] inline std::optional<std::string> pythonWithReaders() {
    std::error_code none;
    const auto folder =
        std::filesystem::read_symlink("/proc/self/exe", none).parent_path().parent_path() / "exchange-python";
    const auto python = "'" + (folder / "bin" / "python").string() + "'";
    const auto make = fmt::format(
        "flock '{0}.lock' sh -c \"{1} -c 'import pyxdf, pyedflib, edfio' || {{ python3 -m venv '{0}' && {1} -m pip "
        "install --quiet --timeout 10 --retries 1 pyxdf==1.17.5 pyEDFlib==0.1.42 edfio==0.4.18; }}\" 2>&1",
        folder.string(), python);
    if (outputOf(make).second != 0) return std::nullopt;
    return python;
}

}  // namespace tacto::test
