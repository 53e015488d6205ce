// FuzzTarget.h - defines a fuzz target: a function of some bytes that aborts the program if something is wrong.
//
//     TACTO_FUZZ(Name, const std::uint8_t* data, std::size_t size) { ...; return 0; }
//
// Each target is in its own Name.cpp, in its own namespace. libFuzzer (the preset "fuzz") has a program for each
// target; other builds have one program for all targets, which finds them by name (ShortRun.cpp).
//
// Thread-safety: before main(), and on its thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>

namespace tacto::fuzz {

using Target = int (*)(const std::uint8_t* data, std::size_t size);

/// The targets of this program.
[[nodiscard]] inline std::map<std::string, Target, std::less<>>& targets() {
    static std::map<std::string, Target, std::less<>> all;
    return all;
}

/// Aborts the program if `held` is false.
inline void require(bool held) {
    if (!held) std::abort();
}

}  // namespace tacto::fuzz

#ifdef TACTO_LIBFUZZER
#define TACTO_FUZZ(name, data, size) extern "C" int LLVMFuzzerTestOneInput(data, size)
#else
#define TACTO_FUZZ(name, data, size)                                                                      \
    static int fuzzOne(data, size);                                                                       \
    [[maybe_unused]] static const bool kKnown = ::tacto::fuzz::targets().emplace(#name, &fuzzOne).second; \
    static int fuzzOne(data, size)
#endif
