// CalibrationView.h - a calibration while it runs: a tab for each quantity, its readings against their commands, and
// their errors in the tolerance band beside them (the errors alone where there is no room for both).
//
// Thread-safety: the GUI thread.
#pragma once

#include <QBoxLayout>
#include <QLabel>
#include <QTabBar>
#include <QWidget>
#include <vector>

#include "app/gui/calibrate/CalibrationReadings.h"

namespace tacto::gui {

class CalibrationPlot;

class CalibrationView final : public QWidget {
    Q_OBJECT
public:
    explicit CalibrationView(QWidget* parent = nullptr);
    /// `parameters`: of the protocol; its tolerances are drawn.
    void begin(const nlohmann::json& parameters);
    /// Whether a trial, as record.trial() was given it, is a reading of a calibration.
    [[nodiscard]] static bool isReading(const nlohmann::json& trial) { return !calibratedQuantity(trial).empty(); }
    void add(const nlohmann::json& trial);
    /// Draws what came since.
    void draw();
    /// The run's results, whose marks and uncertainties are the last word. What they leave out stays as it came.
    void end(const nlohmann::json& results);
    void setSimulated(bool simulated);
    [[nodiscard]] std::size_t readings() const;
    [[nodiscard]] QString quantityShown() const;

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    [[nodiscard]] CalibrationReadings& of(const std::string& quantity);
    void choose(int index);
    void arrange();
    void say();
    nlohmann::json parameters_;
    std::vector<CalibrationReadings> all_;  // as the tabs
    bool dirty_ = false;
    bool follow_ = true;  // the tab goes with the run until the operator chooses one
    bool following_ = false;
    QTabBar* tabs_;
    QLabel* says_;
    QBoxLayout* plots_;
    CalibrationPlot* measured_;
    CalibrationPlot* errors_;
};

}  // namespace tacto::gui
