// TraceMath.h - curves calculated from a capture's channels: power, charge, difference.
//
// A missing sample stays missing in everything calculated from it.
//
// Thread-safety: pure functions.
#pragma once

#include "app/gui/scope/model/Trace.h"

namespace tacto::gui {

/// v·i sample by sample, in W. Both run over the same samples.
[[nodiscard]] TracePtr powerTrace(const Trace& volts, const Trace& amps);

/// ∫ i dt by trapezoids from the record's begin, in C. What flowed while samples were missing is not known: after a
/// gap it counts from zero again.
[[nodiscard]] TracePtr chargeTrace(const Trace& amps);

/// a - b, both in a's unit. b is taken at the same time from the trigger, between its samples by straight line;
/// where b has nothing, the difference has nothing.
[[nodiscard]] TracePtr differenceTrace(const Trace& a, const Trace& b);

/// Appends what is wished for and possible.
void addMath(std::vector<TracePtr>& traces, const MathOptions& math);

}  // namespace tacto::gui
