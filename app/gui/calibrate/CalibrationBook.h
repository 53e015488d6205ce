// CalibrationBook.h - what the store of calibrations says about a stimulator, for the window.
//
// The file is small: it is read when another stimulator is opened, when a run has ended, and on read(). How a
// calibration stands is judged by today's date (UTC) each time it is asked for, so that one which runs out overnight
// does. The judgement is the store's own (CalibrationStore::valid).
#pragma once

#include <QObject>
#include <optional>
#include <vector>

#include "app/gui/controller/BenchController.h"
#include "core/calibration/CalibrationStore.h"

namespace tacto::gui {

/// A stimulator as far as its calibration goes.
struct StimulatorId {
    std::string serial;  ///< empty: it reports none, and cannot be calibrated
    std::string name;
    std::string unit;  ///< "V" or "mA"; empty: not known before it is opened
    bool simulated = false;
    bool operator==(const StimulatorId&) const = default;
};

enum class CalibrationState {
    Valid,
    Never,
    Expired,
    OfSimulation,  ///< the device is real and its calibration was made on a simulated bench
    NoSerial,
    Unreadable,  ///< the store is damaged or cannot be read
};

struct CalibrationStanding {
    CalibrationState state = CalibrationState::Never;
    std::optional<StoredCalibration> newest;  ///< whatever its date
    int age_d = 0;                            ///< the newest entry's age
    int left_d = 0;                           ///< whole days on which it still counts, after today; below 0: expired
    QString why;                              ///< a sentence where it does not count
};

class CalibrationBook final : public QObject {
    Q_OBJECT
public:
    explicit CalibrationBook(BenchController& controller, QObject* parent = nullptr);

    /// The stimulator of the open bench.
    [[nodiscard]] std::optional<StimulatorId> connected() const;
    /// The last one that was open, now or before.
    [[nodiscard]] const std::optional<StimulatorId>& last() const { return last_; }
    /// The stimulators that are or were open, are plugged in (hardware) or are in the store, in this order, each once.
    [[nodiscard]] std::vector<StimulatorId> known() const;
    [[nodiscard]] CalibrationStanding standing(const StimulatorId& stimulator) const;
    /// All calibrations of a serial, the newest first.
    [[nodiscard]] std::vector<StoredCalibration> history(const std::string& serial) const;
    /// Reads the file again.
    void read();

signals:
    void changed();

private:
    void follow();
    BenchController& controller_;
    std::optional<StimulatorId> last_;
    std::optional<CalibrationStore> store_;
    QString fault_;  ///< why store_ is empty
};

/// "calibrated 12 d ago, until 2027-03-01", "not calibrated", "calibration expired 3 d ago".
[[nodiscard]] QString standingText(const CalibrationStanding& standing);
/// What that means for the output, and what to do.
[[nodiscard]] QString standingTip(const CalibrationStanding& standing);

}  // namespace tacto::gui
