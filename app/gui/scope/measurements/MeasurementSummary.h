// MeasurementSummary.h - the latest capture in the width of a dock: a row for each chosen reading, a column for each
// channel, statistics below the unfolded row, the load's |Z|, the capture's age, and whether it is simulated.
//
// The captures of a protocol (RunFeed::captures) go to measure(), which measures them in the background.
// A record without a trigger changes no number: the ages go on, and a note says that no trigger has come since.
// Up to two channels stand next to the reading's name; more stand below the name, so that nothing is cut off.
#pragma once

#include <QElapsedTimer>
#include <QWidget>
#include <optional>
#include <utility>
#include <vector>

#include "app/gui/scope/measurements/CaptureStatistics.h"
#include "app/gui/scope/measurements/Reading.h"
#include "app/gui/scope/model/CapturePipe.h"
#include "core/bench/Telemetry.h"

class QGridLayout;
class QLabel;
class QPushButton;
class QToolButton;
class QVBoxLayout;

namespace tacto::gui {

/// Returns voltage over current at the end of the leading phase (science.md section 4), from plateau and slope. NaN
/// unless one channel in V and one in A were measured.
[[nodiscard]] double impedanceOf(const std::vector<ChannelMeasurement>& measured);

class MeasurementSummary final : public QWidget {
    Q_OBJECT
public:
    explicit MeasurementSummary(QWidget* parent = nullptr);

    /// Shows the readings of `chosen` and lets the user change them. `chosen` outlives this.
    void follow(ChosenReadings& chosen);
    /// Updates the age, and shows the |Z| of the impedance check if the capture has no |Z|. Cheap.
    void refresh(const Telemetry& telemetry);
    /// Measures a capture and shows it. Skips captures that come too fast.
    void measure(std::shared_ptr<const Capture> capture);

public slots:
    /// Shows a capture that the oscilloscope has measured.
    void take(const tacto::gui::ShownPtr& shown);
    void clear();

private:
    struct Figure {
        Reading reading = Reading::Amplitude;
        Statistic statistic = Statistic::Last;
        std::size_t channel = 0;
        QLabel* label = nullptr;
    };
    void lay();
    [[nodiscard]] QStringList channelsNow() const;
    void layRow(Reading reading);
    /// True if the figures stand below the name of the reading, in lines of inLine() channels.
    [[nodiscard]] bool below() const;
    [[nodiscard]] int inLine() const;
    /// Line and column of a channel's figure among all channels.
    [[nodiscard]] std::pair<int, int> placeOf(std::size_t channel) const;
    void layFigures(Reading reading, Statistic statistic, int row, int column);
    void unfold(Reading reading);
    void fill();
    void sayHead();
    void sayImpedance();
    void restyle();

    ChosenReadings own_;
    ChosenReadings* chosen_ = &own_;
    CapturePipe pipe_;
    CaptureStatistics statistics_;
    ShownPtr shown_;  // the latest triggered capture
    bool quietSince_ = false;
    QElapsedTimer since_;
    double checked_ohm_ = kNotMeasured;
    double checkAge_s_ = kNotMeasured;
    std::optional<Reading> unfolded_;

    QLabel* head_;
    QVBoxLayout* column_;
    QWidget* rows_ = nullptr;  // rebuilt when the channels, the chosen readings or the unfolded row change
    QStringList laid_;         // channels of the present rows, in their order
    QGridLayout* grid_ = nullptr;
    std::vector<Figure> figures_;
    std::vector<QLabel*> quiet_;
    QLabel* impedanceName_;
    QLabel* impedance_;
    QLabel* note_;
    QPushButton* choose_;
    QPushButton* reset_;
};

}  // namespace tacto::gui
