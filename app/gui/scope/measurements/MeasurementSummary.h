// MeasurementSummary.h - what the latest capture says, in a dock's width: the chosen readings as rows with the channels
// as columns, statistics below the row that is unfolded, |Z| of the load, how old it is, and whether it is simulated.
//
// A protocol's captures (RunFeed::captures) are handed to measure(), which measures them in the background.
// An untriggered record changes no number: the figures keep their age, and it is said that no trigger came since.
// Up to two channels stand beside the reading's name, more of them below it: nothing is cut.
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

/// Voltage over current at the end of the leading phase (science.md section 4), from the plateaus and their slope. NaN
/// unless a channel in V and one in A were measured.
[[nodiscard]] double impedanceOf(const std::vector<ChannelMeasurement>& measured);

class MeasurementSummary final : public QWidget {
    Q_OBJECT
public:
    explicit MeasurementSummary(QWidget* parent = nullptr);

    /// Shows what is chosen there, and chooses there. `chosen` outlives this.
    void follow(ChosenReadings& chosen);
    /// The age and |Z| of the impedance check, which stands in where the capture gives none. Cheap.
    void refresh(const Telemetry& telemetry);
    /// A capture that has not been measured yet. Some are left out when they come too fast.
    void measure(std::shared_ptr<const Capture> capture);

public slots:
    /// A capture that has been measured: the oscilloscope's.
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
    void layRow(Reading reading);
    /// The channels' figures stand below their reading's name, in lines of inLine().
    [[nodiscard]] bool below() const;
    [[nodiscard]] int inLine() const;
    /// Line and column of a channel among its figures.
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
    ShownPtr shown_;  // the latest that was triggered
    bool quietSince_ = false;
    QElapsedTimer since_;
    double checked_ohm_ = kNotMeasured;
    double checkAge_s_ = kNotMeasured;
    std::optional<Reading> unfolded_;

    QLabel* head_;
    QVBoxLayout* column_;
    QWidget* rows_ = nullptr;  // rebuilt when channels, choice or fold change
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
