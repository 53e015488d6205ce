// ChannelOptions.h - columns, units and probe factors of ReadOptions on what a reader found: the same for every format
// whose channels have names.
//
// Thread-safety: pure functions.
#pragma once

#include "core/formats/CaptureFormat.h"

namespace tacto {

/// A unit as oscilloscopes spell it ("mV", "Volt", "µA", "second") in terms of V, A or s.
struct SpelledUnit {
    std::string_view unit;  ///< "V", "A" or "s"; "" for a bare number
    double factor = 1;      ///< the number times this is in `unit`
};
/// Capitals ignored (no oscilloscope writes megavolts). Nothing for an unknown one.
[[nodiscard]] std::optional<SpelledUnit> spelledUnit(std::string_view text);

/// Keeps and orders the channels, replaces their units and multiplies by probe factors. Channels come in as the file
/// has them, numbered from 1, their samples in the unit V, A or "" they name; --unit CH=mV says that the file's numbers
/// are millivolts, whatever the file said, so `fileFactor` of each channel is what its numbers were multiplied by.
/// Errors: InvalidArgument naming the option, its value and the channels there are, for a channel that is not there or
/// twice, an unknown unit, or a probe factor that is 0 or not finite; for a time column (a format with one handles that
/// itself and passes an empty one).
[[nodiscard]] Result<void> applyChannelOptions(Capture& capture, std::vector<double> fileFactors,
                                               const ReadOptions& options);

}  // namespace tacto
