// Trace.h - one curve of the oscilloscope: a channel of a capture or a curve calculated from channels. Its pyramid
// makes drawing fast, and cursors snap to its edges.
//
// A ShownCapture is made once, outside the window's thread (10 million samples take long to measure). After that it
// never changes.
//
// Thread-safety: pure functions; shared objects are const.
#pragma once

#include <QDateTime>
#include <QString>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/measure/CaptureMask.h"
#include "core/measure/LoadMeasurement.h"
#include "core/measure/MinMaxPyramid.h"
#include "core/measure/PulseMeasurement.h"
#include "core/measure/WaveformMeasurement.h"

namespace tacto::gui {

/// One phase of a measured pulse. Times are in seconds on the session's time base.
struct PhaseEdges {
    double onset_s = 0;
    double end_s = 0;
    bool leading = true;  ///< intervals run from one leading phase to the next
};

/// A pulse that was found but not measured, with the reason in one word.
struct PulseMark {
    double from_s = 0;
    double to_s = 0;
    QString why;
};

struct Trace {
    QString key;     ///< the same for a curve in every capture: "channel/voltage", "math/power", "reference/1"
    QString title;   ///< "Voltage"
    QString letter;  ///< "V", or "V2" if several channels have this unit; on handles, plots and column heads
    QString unit;    ///< "V", "A", "W", "C" or "" for logic
    double rate_hz = 0;
    double start_s = 0;  ///< time of sample 0, on the session's time base
    double zero_s = 0;   ///< trigger time of the capture, shown as time 0 on the plot
    std::shared_ptr<const std::vector<float>> samples;
    MinMaxPyramid pyramid;  ///< over `samples`
    double low = 0;         ///< input range; low equals high if unknown. A sample at or beyond a limit is clipped.
    double high = 0;
    std::vector<PhaseEdges> edges;  ///< edges of the measured pulses, in time order
    std::vector<PulseMark> marks;   ///< marks of the pulses that were not measured
    std::vector<double> levels;     ///< resting levels of the signal, to which level cursors snap

    [[nodiscard]] std::size_t size() const noexcept { return samples ? samples->size() : 0; }
    [[nodiscard]] double end_s() const noexcept { return start_s + static_cast<double>(size()) / rate_hz; }
    /// Returns the value at a session time, with straight lines between samples as drawn. NaN outside the record and
    /// next to a missing sample. Every level at a time is read with this function.
    [[nodiscard]] double valueAt(double t_s) const noexcept;
};
using TracePtr = std::shared_ptr<const Trace>;

/// One record on a time axis.
struct TraceSpan {
    TracePtr trace;
    double key_s = 0;  ///< time of sample 0 on the axis
    [[nodiscard]] double length_s() const noexcept { return static_cast<double>(trace->size()) / trace->rate_hz; }
};

/// The curves that are calculated in addition to the channels.
struct MathOptions {
    bool power = false;   ///< first channel in V times first channel in A
    bool charge = false;  ///< charge of the first channel in A
    QString minuend;      ///< key of a channel; empty: no difference is calculated
    QString subtrahend;   ///< key of a channel in the same unit; empty: `reference` is subtracted
    TracePtr reference;
};

/// The drive that was asked for when a capture was taken.
struct AskedDrive {
    bool byHand = true;  ///< false: the fingertip controls the output, and amplitude and interval follow the touch
    double amplitude_v = 0;
    double interval_s = 0;
};

struct ShownCapture {
    std::shared_ptr<const Capture> capture;
    std::size_t averaged = 0;                     ///< number of captures averaged; 0: a single capture
    QString source;                               ///< the file's name; empty for the bench
    QDateTime taken;                              ///< when the capture came from the bench; otherwise invalid
    std::optional<AskedDrive> asked;              ///< what was asked of a bench that delivers output
    double zero_s = 0;                            ///< time of the trigger, or of the first sample without a trigger
    std::vector<TracePtr> traces;                 ///< channels in the capture's order, then calculated curves
    std::vector<ChannelMeasurement> measurement;  ///< one for each channel
    std::vector<WaveformMeasurement> waveforms;   ///< one for each channel
    std::vector<PulseLoad> loads;                 ///< one for each pulse of channel loadCurrent
    std::optional<std::size_t> loadCurrent;       ///< the current's channel; nothing unless there is one V and one A
    std::optional<MaskCheck> mask;                ///< result of the mask test, before any averaging; nothing: no mask
    std::shared_ptr<const CaptureMask> judgedBy;  ///< the mask used for this test
    bool follows = true;                          ///< no capture was left out before this one
    std::vector<std::string> warnings;            ///< from the measurement

    [[nodiscard]] TracePtr trace(const QString& key) const;
    [[nodiscard]] double end_s() const noexcept;
    [[nodiscard]] double length_s() const noexcept { return end_s() - capture->start_s; }
};
using ShownPtr = std::shared_ptr<const ShownCapture>;

[[nodiscard]] QString channelKey(const std::string& name);

/// Measures every channel and builds every pyramid. Slow for long captures; call it outside the window's thread.
[[nodiscard]] ShownPtr prepareCapture(std::shared_ptr<const Capture> capture, const MathOptions& math = {});
/// Returns the same measurement with other calculations.
[[nodiscard]] ShownPtr withMath(const ShownCapture& shown, const MathOptions& math);

/// Makes a trace from `samples` and builds its pyramid.
[[nodiscard]] std::shared_ptr<Trace> makeTrace(const QString& key, const QString& title, const QString& unit,
                                               std::shared_ptr<const std::vector<float>> samples, double rate_hz,
                                               double start_s, double zero_s);

// Curves calculated from channels. If a sample is missing, the calculated sample is missing too.
/// Returns v·i in W, sample by sample. Both traces have the same sample times.
[[nodiscard]] TracePtr powerTrace(const Trace& volts, const Trace& amps);

/// Returns ∫ i dt from the start of the record in C, by the trapezoidal rule. The charge during missing samples is
/// unknown: after a gap the integral starts again at zero.
[[nodiscard]] TracePtr chargeTrace(const Trace& amps);

/// Returns a - b in the unit of both. b is read at the same time from the trigger, with straight lines between samples;
/// if b has no value there, the difference has none.
[[nodiscard]] TracePtr differenceTrace(const Trace& a, const Trace& b);

/// Appends the curves that `math` asks for and the channels allow.
void addMath(std::vector<TracePtr>& traces, const MathOptions& math);

/// Two neighbouring edges, with a text about the time between them.
struct EdgeReading {
    double from_s = 0, to_s = 0;
    QString text;  ///< "Width 200.0 µs · interval 4.000 ms (250.0 Hz)"
    bool operator==(const EdgeReading&) const = default;
};

/// Returns the edge nearest to `time_s` if it is nearer than `reach_s`; otherwise `time_s`.
[[nodiscard]] double snappedToEdge(const std::vector<TraceSpan>& spans, double time_s, double reach_s);
/// Returns the first edge after `time_s` (`direction` 1) or before it (-1), or `time_s` if there is none. Passes over
/// an edge nearer than `least_s`, because the cursor already stands on that edge.
[[nodiscard]] double nextEdge(const std::vector<TraceSpan>& spans, double time_s, double direction, double least_s);
/// Returns onset and end of the pulse with the onset nearest to `time_s`.
[[nodiscard]] std::optional<std::pair<double, double>> pulseNear(const std::vector<TraceSpan>& spans, double time_s);
/// Returns onset and end of the pulse wholly between two times whose onset is nearest to `time_s`; without one, of the
/// phase. Nothing if there is neither.
[[nodiscard]] std::optional<std::pair<double, double>> pulseWithin(const std::vector<TraceSpan>& spans, double from_s,
                                                                   double to_s, double time_s);
/// Returns the phase, or the rest between two phases, that contains `time_s`.
[[nodiscard]] std::optional<EdgeReading> edgesAround(const std::vector<TraceSpan>& spans, double time_s);

}  // namespace tacto::gui
