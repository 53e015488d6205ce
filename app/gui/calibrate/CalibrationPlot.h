// CalibrationPlot.h - plot of a calibration's readings against their commands: as measured, with the fitted line; or as
// errors within the tolerance band, with each level's mean and uncertainty, and the name of the level nearest its
// tolerance. Upward and downward sweeps look different; outliers are marked and kept.
#pragma once

#include <qcustomplot.h>
#include <vector>

#include "app/gui/calibrate/CalibrationReadings.h"
#include "app/gui/theme/Theme.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

class CalibrationPlot final : public QCustomPlot {
    Q_OBJECT
public:
    enum class Kind { Measured, Errors };
    explicit CalibrationPlot(Kind kind, QWidget* parent = nullptr);
    /// Empties the plot and shows `why` in it; what will appear there if empty.
    void clear(const QString& why = {});
    void show(const CalibrationReadings& of);
    void setSimulated(bool simulated) { showWatermark(*watermark_, simulated); }

    [[nodiscard]] int drawnUp() const { return up_->dataCount(); }
    [[nodiscard]] int drawnDown() const { return down_->dataCount(); }
    [[nodiscard]] int drawnMarked() const { return marked_->dataCount(); }
    [[nodiscard]] int drawnMeans() const { return means_->dataCount(); }
    [[nodiscard]] bool hasBand() const { return bandTop_->dataCount() > 0; }
    /// Returns the range that the band covers, in the unit of the axis.
    [[nodiscard]] QCPRange bandReach() const {
        return {bandTop_->data()->at(0)->key, bandTop_->data()->at(bandTop_->dataCount() - 1)->key};
    }
    [[nodiscard]] bool hasLine() const { return line_->dataCount() > 0; }
    /// Returns the text below the nearest level's title, such as "10 V: …"; empty before the result.
    [[nodiscard]] QString nearestShown() const { return nearestText_->visible() ? nearestText_->text() : QString(); }

private:
    void build();
    void addLegend();
    void drawLine(const CalibrationReadings& of, const AxisUnit& across, const AxisUnit& upward);
    void drawBand(const CalibrationReadings& of, const AxisUnit& across, const AxisUnit& upward);
    void drawMeans(const CalibrationReadings& of, const AxisUnit& across, const AxisUnit& upward);
    void drawReadings(const CalibrationReadings& of, const AxisUnit& across, const AxisUnit& upward);
    void nameNearest(const CalibrationReadings& of, const AxisUnit& across, const AxisUnit& upward);
    /// Returns a reading as drawn: measured, or its error, which in a check counts from the line that is checked.
    [[nodiscard]] double shown(const CalibrationReadings& of, double commanded, double measured) const;
    void hideNearest();
    void colour();
    const Kind kind_;
    QCPGraph* bandBottom_ = nullptr;
    QCPGraph* bandTop_ = nullptr;
    QCPGraph* line_ = nullptr;
    QCPGraph* up_ = nullptr;
    QCPGraph* down_ = nullptr;
    QCPGraph* marked_ = nullptr;
    QCPGraph* means_ = nullptr;
    QCPGraph* nominal_ = nullptr;  ///< the fitted line; null unless the plot shows errors
    QCPErrorBars* bars_ = nullptr;
    QCPItemRect* nearest_ = nullptr;
    QCPItemText* nearestText_ = nullptr;
    QCPItemText* nearestTitle_ = nullptr;
    QCPItemLine* nearestLead_ = nullptr;
    QCPItemText* empty_ = nullptr;
    QCPItemText* watermark_ = nullptr;
};

}  // namespace tacto::gui
