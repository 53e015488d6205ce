// CalibrationView.h - a calibration while it runs and at its end: one plot, the errors in their tolerance band (or the
// readings against their commands), and a card for each quantity that says how much of its tolerance it uses.
#pragma once

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QWidget>
#include <functional>
#include <vector>

#include "app/gui/calibrate/CalibrationReadings.h"
#include "app/gui/theme/PlotPicture.h"

namespace tacto::gui {

class CalibrationPlot;
class PageStack;
class ToleranceCard;

class CalibrationView final : public QWidget {
    Q_OBJECT
public:
    explicit CalibrationView(QWidget* parent = nullptr);
    /// `parameters`: of the protocol; its tolerances are drawn.
    void begin(const nlohmann::json& parameters);
    /// Adds a reading, as record.trial() was given it; skips a trial that is no reading.
    void add(const nlohmann::json& trial);
    /// Draws what came since.
    void draw();
    /// Takes the run's results, whose marks and uncertainties are the last word. What they leave out stays as it came.
    void end(const nlohmann::json& results);
    void setSimulated(bool simulated);
    [[nodiscard]] std::size_t readings() const;
    [[nodiscard]] QString quantityShown() const;
    /// Residuals or measured, in the line above the plot; or wherever its owner puts it: it is visible with the plot.
    [[nodiscard]] QComboBox& plotKind() noexcept { return *kind_; }
    /// Pictures of a plot say `caption`, and then what stands above the plot.
    void captionPicturesBy(const std::function<PictureCaption()>& caption);

signals:
    /// The plot without what is around it, or back.
    void plotOnlyWanted();

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;

private:
    [[nodiscard]] QWidget* buildHead();
    void addTools(QBoxLayout& row);
    [[nodiscard]] QCustomPlot& plot() const;
    [[nodiscard]] CalibrationReadings& of(const std::string& quantity);
    void choose(int index);
    [[nodiscard]] int nearest() const;
    void arrange();
    void shareWidth(int columns);
    void say();
    nlohmann::json parameters_;
    std::vector<CalibrationReadings> all_;
    std::vector<ToleranceCard*> cards_;  // as all_
    int shown_ = -1;
    bool dirty_ = false;
    bool follow_ = true;  // the plot goes with the run until the operator chooses a card
    QWidget* head_ = nullptr;
    QLabel* title_ = nullptr;
    QLabel* says_ = nullptr;
    QComboBox* kind_ = nullptr;
    PageStack* plots_;
    QGridLayout* places_;
    int columns_ = 0;
    CalibrationPlot* measured_;
    CalibrationPlot* errors_;
};

}  // namespace tacto::gui
