// CalibrationBook.h - gives the window the contents of the calibration store for each stimulator.
//
// The small file is read when another stimulator is opened, after each run, and on read(). Validity is judged with
// today's date (UTC) at each request, so that a calibration that expires overnight is noticed. The rules are the
// store's own (CalibrationStore::valid).
#pragma once

#include <QObject>
#include <optional>
#include <vector>

#include "app/gui/controller/BenchController.h"
#include "core/calibration/CalibrationStore.h"

namespace tacto::gui {

/// What identifies a stimulator for its calibration.
struct StimulatorId {
    std::string serial;  ///< empty: it has none, and cannot be calibrated
    std::string name;
    std::string unit;  ///< "V" or "mA"; empty: unknown before it is opened
    bool simulated = false;
    bool operator==(const StimulatorId&) const = default;
};

enum class CalibrationState {
    Valid,
    Never,
    Expired,
    OfSimulation,  ///< the device is real, but its calibration was made on a simulated bench
    NoSerial,
    Unreadable,  ///< the store is damaged or cannot be read
};

struct CalibrationStanding {
    CalibrationState state = CalibrationState::Never;
    std::optional<StoredCalibration> newest;  ///< the newest entry, whatever its date
    int age_d = 0;                            ///< age of the newest entry in days
    int left_d = 0;                           ///< days of validity left after today; below 0: expired
    QString why;                              ///< a sentence that says why it is not valid
};

class CalibrationBook final : public QObject {
    Q_OBJECT
public:
    explicit CalibrationBook(BenchController& controller, QObject* parent = nullptr);

    /// Returns the stimulator of the open bench.
    [[nodiscard]] std::optional<StimulatorId> connected() const;
    /// Returns the stimulator that was opened last; it may be closed now.
    [[nodiscard]] const std::optional<StimulatorId>& last() const { return last_; }
    /// Returns all stimulators that are or were open, are connected (hardware) or are stored; in this order, each once.
    [[nodiscard]] std::vector<StimulatorId> known() const;
    [[nodiscard]] CalibrationStanding standing(const StimulatorId& stimulator) const;
    /// Returns all calibrations for a serial number, newest first.
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

/// Returns "calibrated 12 d ago, until 2027-03-01", "not calibrated", "calibration expired 3 d ago".
[[nodiscard]] QString standingText(const CalibrationStanding& standing);
/// Returns the effect of that state on the output, and what to do.
[[nodiscard]] QString standingTip(const CalibrationStanding& standing);

}  // namespace tacto::gui
