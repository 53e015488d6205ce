// LslNotes.h - takes the texts of another program's LSL stream in, as notes of the session.
//
// The text of a sample comes from any program on the network: it may hold anything, be of any length, and come as fast
// as the network lets it. So at most kPerSecond are taken each second, what is no UTF-8 or not printable is written as
// escapes, and what is longer than kMaxBytes is cut. Everything left out or cut is counted.
//
// Thread-safety: run() has one caller, a thread of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "core/base/Clock.h"
#include "core/exchange/lsl/LslClock.h"
#include "core/exchange/lsl/LslLibrary.h"

namespace tacto {

/// A text that came in.
struct LslNote {
    Instant at{0};
    std::string text;        ///< printable; at most LslNotes::kMaxBytes long
    bool stamped = true;     ///< false: its stamp is of no use, and `at` is when it came
    bool shortened = false;  ///< the rest of the text is left out
};

struct LslNoteTally {
    std::uint64_t taken = 0;
    std::uint64_t left = 0;  ///< came too fast, or were empty
    std::uint64_t unstamped = 0;
    std::uint64_t shortened = 0;
    std::uint64_t streams = 0;  ///< how often a stream of that name was found
    std::string trouble;        ///< why the last stream of that name is not taken; empty: it is
    bool operator==(const LslNoteTally&) const = default;
};

class LslNotes {
public:
    static constexpr int kPerSecond = 20;          ///< on average; as many at once
    static constexpr std::size_t kMaxBytes = 200;  ///< of a note

    /// Checks the name of a stream. Errors: InvalidArgument for one that is empty, longer than 100 bytes, not
    /// printable, holds a quotation mark, or is of a stream of this program.
    [[nodiscard]] static Result<void> checkName(std::string_view stream);

    /// Makes a note of a text.
    [[nodiscard]] static LslNote noteOf(std::string_view text, double stamp_s, const LslClock& clock, Instant now);

    /// Looks for the stream and hands its notes to `take`, until `ends` says so, which is asked every 2 s while it
    /// looks, then every 0.5 s.
    /// A stream that is gone is looked for again. Returns what became of them.
    [[nodiscard]] static LslNoteTally run(const LslLibrary& library, const std::string& stream, const LslClock& clock,
                                          const Clock& session, const std::function<bool()>& ends,
                                          const std::function<void(const LslNote&)>& take);
};

}  // namespace tacto
