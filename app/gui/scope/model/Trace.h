// Trace.h - one curve of the oscilloscope: a channel of a capture, or something calculated from it, with the pyramid
// that makes it quick to draw and the edges that cursors snap to.
//
// A ShownCapture is made once, off the window's thread (10 million samples take a while to measure), and then only
// looked at: everything here is constant once it is shared.
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

/// One phase of a measured pulse, seconds on the session's time base.
struct PhaseEdges {
    double onset_s = 0;
    double end_s = 0;
    bool leading = true;  ///< intervals run from leading phase to leading phase
};

/// A pulse that was found and not measured, and why in a word.
struct PulseMark {
    double from_s = 0;
    double to_s = 0;
    QString why;
};

struct Trace {
    QString key;     ///< "channel/voltage", "math/power", "reference/1": the same curve in every capture
    QString title;   ///< "Voltage"
    QString letter;  ///< "V", or "V2" where several channels have the unit; on handles, plots and above columns
    QString unit;    ///< "V", "A", "W", "C" or "" for logic
    double rate_hz = 0;
    double start_s = 0;  ///< time of sample 0, on the session's time base
    double zero_s = 0;   ///< the trigger of its capture: time 0 on the plot
    std::shared_ptr<const std::vector<float>> samples;
    MinMaxPyramid pyramid;  ///< over `samples`
    double low = 0;         ///< the input's range; equal = unknown. At or beyond it a sample is clipped.
    double high = 0;
    std::vector<PhaseEdges> edges;  ///< edges of the measured pulses, in time order
    std::vector<PulseMark> marks;   ///< marks of the pulses that were not measured
    std::vector<double> levels;     ///< the levels at which it rests, for level cursors

    [[nodiscard]] std::size_t size() const noexcept { return samples ? samples->size() : 0; }
    [[nodiscard]] double end_s() const noexcept { return start_s + static_cast<double>(size()) / rate_hz; }
    /// The value at a time on the session's time base, between samples by straight line as it is drawn; NaN outside the
    /// record and beside a missing sample. Every level at a time is read here.
    [[nodiscard]] double valueAt(double t_s) const noexcept;
};
using TracePtr = std::shared_ptr<const Trace>;

/// One record on a time axis.
struct TraceSpan {
    TracePtr trace;
    double key_s = 0;  ///< place of its sample 0 on the axis
    [[nodiscard]] double length_s() const noexcept { return static_cast<double>(trace->size()) / trace->rate_hz; }
};

/// The calculations beside the channels.
struct MathOptions {
    bool power = false;   ///< first channel in V times first in A
    bool charge = false;  ///< whether it is the charge of the first channel in A
    QString minuend;      ///< key of a channel; empty for no difference
    QString subtrahend;   ///< key of a channel of the same unit, or empty when `reference` is subtracted
    TracePtr reference;
};

/// The order for the output when a capture came.
struct AskedDrive {
    bool byHand = true;  ///< false: the fingertip drives, and amplitude and interval follow the touch
    double amplitude_v = 0;
    double interval_s = 0;
};

struct ShownCapture {
    std::shared_ptr<const Capture> capture;
    std::size_t averaged = 0;                     ///< of how many captures it is the mean; 0: as it was taken
    QString source;                               ///< "" for the bench's own, else the file's name
    QDateTime taken;                              ///< when it came from the bench; else not valid
    std::optional<AskedDrive> asked;              ///< the order for a bench that delivers
    double zero_s = 0;                            ///< trigger, or the record's begin where there was none
    std::vector<TracePtr> traces;                 ///< channels in the capture's order, then what was calculated
    std::vector<ChannelMeasurement> measurement;  ///< one for each channel
    std::vector<WaveformMeasurement> waveforms;   ///< one for each channel
    std::vector<PulseLoad> loads;                 ///< one for each pulse of the current below
    std::optional<std::size_t> loadCurrent;       ///< the current's channel; nothing unless there are one V and one A
    std::optional<MaskCheck> mask;                ///< judged as it was taken, before any averaging; nothing: no mask
    std::shared_ptr<const CaptureMask> judgedBy;  ///< the mask of that check
    bool follows = true;                          ///< no capture was left out between the one before it and this
    std::vector<std::string> warnings;            ///< the measurement's warnings

    [[nodiscard]] TracePtr trace(const QString& key) const;
    [[nodiscard]] double end_s() const noexcept;
    [[nodiscard]] double length_s() const noexcept { return end_s() - capture->start_s; }
};
using ShownPtr = std::shared_ptr<const ShownCapture>;

[[nodiscard]] QString channelKey(const std::string& name);

/// Measures every channel, builds every pyramid. Takes as long as the capture is; call it off the window's thread.
[[nodiscard]] ShownPtr prepareCapture(std::shared_ptr<const Capture> capture, const MathOptions& math = {});
/// The same measurement with other calculations.
[[nodiscard]] ShownPtr withMath(const ShownCapture& shown, const MathOptions& math);

/// A trace of its own: `samples` with a pyramid over them.
[[nodiscard]] std::shared_ptr<Trace> makeTrace(const QString& key, const QString& title, const QString& unit,
                                               std::shared_ptr<const std::vector<float>> samples, double rate_hz,
                                               double start_s, double zero_s);

// Curves calculated from channels. A missing sample stays missing in everything calculated from it.
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

/// Two neighbouring edges and what lies between them, in words.
struct EdgeReading {
    double from_s = 0, to_s = 0;
    QString text;  ///< "Width 200.0 µs · interval 4.000 ms (250.0 Hz)"
    bool operator==(const EdgeReading&) const = default;
};

/// The edge nearest to `time_s`, if one is nearer than `reach_s`; else `time_s`.
[[nodiscard]] double snappedToEdge(const std::vector<TraceSpan>& spans, double time_s, double reach_s);
/// The first edge after `time_s` (`direction` 1) or before it (-1); `time_s` without one. A cursor stands on an edge
/// that is nearer than `least_s`.
[[nodiscard]] double nextEdge(const std::vector<TraceSpan>& spans, double time_s, double direction, double least_s);
/// From the onset to the end of the pulse whose onset is nearest to `time_s`.
[[nodiscard]] std::optional<std::pair<double, double>> pulseNear(const std::vector<TraceSpan>& spans, double time_s);
/// The phase, or the rest between two phases, that `time_s` lies in.
[[nodiscard]] std::optional<EdgeReading> edgesAround(const std::vector<TraceSpan>& spans, double time_s);

}  // namespace tacto::gui
