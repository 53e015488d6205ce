// Reading.h - the quantities measured in every capture (science.md section 8 and core/measure/WaveformMeasurement.h),
// with name, explanation, unit and the key under which a choice is stored.
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

/// In the order of the tables: the most important readings first.
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
    QString key;        ///< the key in the settings: "amplitude"
    QString title;      ///< the name as shown: "Amplitude"
    QString explained;  ///< one or two sentences for a tool tip
    QString unit;       ///< "s", "%", "Hz", "C", "J"; empty if it is the channel's unit
};
[[nodiscard]] ReadingName nameOf(Reading reading);
[[nodiscard]] std::optional<Reading> readingOfKey(const QString& key);

/// Returns all readings of a channel in one capture: one per measured pulse, or per train for the interval; one for the
/// waveform. Net charge and energy belong to the current channel, if the capture has one voltage and one current.
/// Leaves out edges that are too short for the sample rate.
[[nodiscard]] std::vector<double> readingsOf(Reading reading, const ShownCapture& shown, std::size_t channel);
/// Returns two sample intervals if the rise or fall of every pulse is shorter: the samples then show only that the true
/// value is below this bound.
[[nodiscard]] std::optional<double> upperBound(Reading reading, const ShownCapture& shown, std::size_t channel);
/// Returns the text of an upper bound: "≤ 1 µs".
[[nodiscard]] QString upperBoundText(double bound_s);
/// Returns "40.02 V" or "0.05 %"; "–" for NaN, and for the charge of a channel that is not a current.
[[nodiscard]] QString readingText(Reading reading, double value, const QString& channelUnit, int digits = 4);
/// Says in one or two sentences why there is no reading, or only an upper bound.
[[nodiscard]] QString whyMissing(Reading reading, const ShownCapture& shown, std::size_t channel);

/// The readings that the user chose, shared by the table and the dock and kept in the settings.
class ChosenReadings final : public QObject {
    Q_OBJECT
public:
    ChosenReadings();
    /// The chosen readings, in the order of Reading.
    [[nodiscard]] const std::vector<Reading>& all() const noexcept { return chosen_; }
    [[nodiscard]] bool has(Reading reading) const;
    void choose(Reading reading, bool on);
    void chooseStandard();

    void save(QSettings& settings) const;
    /// Skips unknown names. Keeps the present choice if no name is known.
    void restore(const QSettings& settings);

signals:
    void changed();

private:
    std::vector<Reading> chosen_;
};

/// Makes a menu for choosing readings. It stays open after each choice and closes with its last row: Esc would stop the
/// output. `chosen` outlives the menu.
[[nodiscard]] QMenu* makeReadingsMenu(ChosenReadings& chosen, QWidget* parent);

}  // namespace tacto::gui
