// MeasurementSummary.h - what the latest capture says, in a dock's width: amplitude, width, interval and charge of each
// channel, |Z| of the load, how old it is, and whether it is simulated.
//
// For the window's "Measurements" dock:
//
//     auto* summary = new MeasurementSummary(dock);
//     connect(scope, &ScopeWorkspace::captureShown, summary, &MeasurementSummary::take);
//     scope->setWatched(true);        // captures are taken though the oscilloscope is not visible
//     ... 30 times a second: scope->refresh(telemetry) whatever is visible, and
//                            summary->refresh(telemetry) while the dock is.
//
// A protocol's captures (RunFeed::captures) are handed to measure(), which measures them in the background.
// An untriggered record changes no number: the figures keep their age, and it is said that no trigger came since.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QElapsedTimer>
#include <QWidget>
#include <array>
#include <vector>

#include "app/gui/scope/CapturePipe.h"
#include "core/bench/Telemetry.h"

class QGridLayout;
class QLabel;

namespace tacto::gui {

/// Voltage over current at the end of the leading phase (science.md section 4), from the plateaus and their slope. NaN
/// unless a channel in V and one in A were measured.
[[nodiscard]] double impedanceOf(const std::vector<ChannelMeasurement>& measured);

class MeasurementSummary final : public QWidget {
    Q_OBJECT
public:
    explicit MeasurementSummary(QWidget* parent = nullptr);

    /// Age and the impedance check's |Z|, which stands in where the capture gives none. Cheap.
    void refresh(const Telemetry& telemetry);
    /// A capture that has not been measured yet. Of those that come too fast some are left out.
    void measure(std::shared_ptr<const Capture> capture);

public slots:
    /// A capture that has been measured: the oscilloscope's.
    void take(const tacto::gui::ShownPtr& shown);
    void clear();

protected:
    void changeEvent(QEvent* event) override;

private:
    static constexpr std::size_t kRows = 4;
    struct Column {
        QString name, unit;
        QLabel* title = nullptr;
        std::array<QLabel*, kRows> values{};
    };
    void lay(const std::vector<ChannelMeasurement>& measured);
    void fill();
    void sayHead();
    void sayImpedance();
    void restyle();

    CapturePipe pipe_;
    ShownPtr shown_;  // the latest that was triggered
    bool quietSince_ = false;
    QElapsedTimer since_;
    double checked_ohm_ = kNotMeasured;
    double checkAge_s_ = kNotMeasured;

    QLabel* head_;
    QGridLayout* grid_;
    std::array<QLabel*, kRows> names_{};
    std::vector<Column> columns_;
    QLabel* impedanceName_;
    QLabel* impedance_;
    QLabel* note_;
};

}  // namespace tacto::gui
