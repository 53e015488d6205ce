// Confirmation.h - a word typed on a terminal before something dangerous: the second of two steps (H12).
//
// Thread-safety: one thread at a time.
#pragma once

#include <string_view>

#include "app/run/SignalStop.h"
#include "core/base/Units.h"

namespace tacto::cli {

/// Whether the operator can be asked: input and messages are a terminal.
[[nodiscard]] bool canAsk();

enum class Answer { Confirmed, Otherwise, TooLate, Signalled };

/// After half a second, in which what was typed before arrives and is forgotten, prints `prompt` on stderr and waits
/// for one line. Confirmed only for `word` itself. Returns within 50 ms of a signal.
[[nodiscard]] Answer askFor(std::string_view word, std::string_view prompt, Seconds within,
                            const SignalStop& interrupts);

}  // namespace tacto::cli
