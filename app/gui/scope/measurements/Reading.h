// Reading.h - the quantities that are measured of every capture (science.md section 8 and
// core/measure/WaveformMeasurement.h), each described once: name, explanation, unit, and how it is stored as a choice.
//
// Thread-safety: pure functions.
#pragma once

#include <QObject>
#include <QString>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "app/gui/scope/model/Trace.h"

class QMenu;
class QSettings;
class QWidget;

namespace tacto::gui {

/// In the order of the tables: what is looked at first stands first.
enum class Reading {
    Amplitude,
    PeakToPeak,
    Width,
    Gap,
    Interval,
    Rise,
    Fall,
    Charge,
    Imbalance,
    Overshoot,
    Droop,
    Frequency,
    Duty,
    Rms,
    Mean,
    SecondAmplitude,
    SecondWidth,
    SecondCharge,
    NetCharge,
    Energy,
    Pulses
};
inline constexpr std::size_t kReadings = static_cast<std::size_t>(Reading::Pulses) + 1;
[[nodiscard]] std::array<Reading, kReadings> allReadings();

struct ReadingName {
    QString key;        ///< "amplitude": as it is stored
    QString title;      ///< "Amplitude"
    QString explained;  ///< says in one or two sentences what it is, for a tool tip
    QString unit;       ///< "s", "%", "Hz", "C", "J"; empty: the channel's own
};
[[nodiscard]] ReadingName nameOf(Reading reading);
[[nodiscard]] std::optional<Reading> readingOfKey(const QString& key);

/// All readings of the channel in one capture: one per measured pulse, per train for the interval, one for the
/// waveform. Net charge and energy belong to the current channel, where the capture has one voltage and one current.
/// Edges that the samples do not resolve are left out.
[[nodiscard]] std::vector<double> readingsOf(Reading reading, const ShownCapture& shown, std::size_t channel);
/// Two sample intervals, where the rise or the fall of every pulse is shorter than that: the samples do not resolve it,
/// and it lies below.
[[nodiscard]] std::optional<double> upperBound(Reading reading, const ShownCapture& shown, std::size_t channel);
/// "≤ 1 µs".
[[nodiscard]] QString upperBoundText(double bound_s);
/// "40.02 V", "0.05 %"; "–" for NaN, and for the charge of a channel that is not a current.
[[nodiscard]] QString readingText(Reading reading, double value, const QString& channelUnit, int digits = 4);
/// Why there is no reading, or only an upper bound, in a sentence or two.
[[nodiscard]] QString whyMissing(Reading reading, const ShownCapture& shown, std::size_t channel);

/// Which readings are shown, chosen freely and remembered; one choice for the table and the dock.
class ChosenReadings final : public QObject {
    Q_OBJECT
public:
    ChosenReadings();
    /// The readings, in Reading's order.
    [[nodiscard]] const std::vector<Reading>& all() const noexcept { return chosen_; }
    [[nodiscard]] bool has(Reading reading) const;
    void choose(Reading reading, bool on);
    void chooseStandard();

    void save(QSettings& settings) const;
    /// Names that are none are passed over; without any the choice stays.
    void restore(const QSettings& settings);

signals:
    void changed();

private:
    std::vector<Reading> chosen_;
};

/// A menu in which they are chosen; it stays open from one to the next, until its last row
/// closes it: Esc would stop the output. `chosen` outlives it.
[[nodiscard]] QMenu* makeReadingsMenu(ChosenReadings& chosen, QWidget* parent);

}  // namespace tacto::gui
