// InstrumentStatement.h - what is stated of an oscilloscope's accuracy, and by whom: science.md section 12.
//
// A figure is stated or unknown (NaN), and unknown is never zero (hazard H9). Statements come from a data sheet
// (resources/instruments), the keys of a device's address, or a certificate of calibration; each overrides those
// before it, figure by figure, and each figure keeps who stated it. What a capture states itself (the twin, a header
// that this program wrote) stays where nothing else is stated.
//
// Thread-safety: values and pure functions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/NaN.h"
#include "core/measure/Capture.h"

namespace tacto {

/// One figure with its source. NaN: not stated.
struct Stated {
    double value = kNaN;
    std::string by{};
    [[nodiscard]] bool known() const noexcept;
};

/// Half-widths. A certificate's U (k = 2) stands as the half-width whose 95 % it is, U/0.95.
struct ChannelStatement {
    Stated gain;        ///< relative
    Stated offset;      ///< in the channel's unit
    Stated linearity;   ///< share of full scale (high less low): a gain error that is stated of full scale
    Stated probe;       ///< relative, of the probe, or of the shunt on the current channel
    Stated resolution;  ///< one step, in the channel\'s unit
};
struct InstrumentStatement {
    ChannelStatement voltage;
    ChannelStatement current;
    Stated timeBase;  ///< relative
    Stated stamp_s;   ///< how far the stamps of separate records are off against each other
};

/// `over` wins where it states something.
[[nodiscard]] InstrumentStatement merged(const InstrumentStatement& under, const InstrumentStatement& over);

/// Writes what is stated into `capture`: its channels in V take `voltage`, those in A `current`.
void applyStatement(Capture& capture, const InstrumentStatement& statement);

/// What a budget needs and is not stated, for people: "the gain of voltage", "the time base". Empty: all is
/// stated. The offset is not among them: levels are read from their own baseline.
[[nodiscard]] std::vector<std::string> notStated(const Capture& capture);
/// "the oscilloscope does not state the gain of voltage and the time base"; empty where all is stated.
[[nodiscard]] std::string notStatedText(const Capture& capture);

}  // namespace tacto
