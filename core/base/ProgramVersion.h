// ProgramVersion.h - what this program was built from: shown by `--version`, and written into sessions, reports and
// exports.
//
// Thread-safety: constant.
#pragma once

#include <span>

namespace tacto {

struct ProgramVersion {
    struct Library {
        const char* name;     ///< "Qt"
        const char* version;  ///< "6.4.2"
    };
    const char* version;  ///< "0.2.0" of a release, else "0.2.0+git20261130.83b220b", with ".dirty" if `dirty`
    const char* commit;   ///< 40 hexadecimal digits; "unknown" if the tree had no git
    const char* date;     ///< day of the commit (UTC): "2026-11-30"; empty if the commit is unknown
    bool dirty;           ///< the tree had changes that are in no commit; false if the commit is unknown
    const char* compiler;
    std::span<const Library> libraries;  ///< those with which the program was built
};

/// Of a program that has no resources/packaging/ProgramVersion.cpp.in, such as a test: the release alone.
[[nodiscard]] const ProgramVersion& programVersion() noexcept;

}  // namespace tacto
