// CalibrationView.h - a calibration during and after its run: one plot of the errors in their tolerance band (or of
// readings against commands), and for each quantity a card that shows how much of its tolerance is used.
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
    /// `parameters`: the protocol's; their tolerances are drawn.
    void begin(const nlohmann::json& parameters);
    /// Adds a reading passed to record.trial(); ignores a trial that is not a reading.
    void add(const nlohmann::json& trial);
    /// Draws the readings added since the last call.
    void draw();
    /// Takes over the marks and uncertainties of the run's results; keeps the values that the results leave out.
    void end(const nlohmann::json& results);
    void setSimulated(bool simulated);
    [[nodiscard]] std::size_t readings() const;
    [[nodiscard]] QString quantityShown() const;
    /// Returns the widget that chooses residuals or measured values; visible with the plot, wherever its owner puts it.
    [[nodiscard]] QComboBox& plotKind() noexcept { return *kind_; }
    /// Sets the caption of plot pictures, to which the text above the plot is added.
    void captionPicturesBy(const std::function<PictureCaption()>& caption);

signals:
    /// Asks to hide or show everything around the plot.
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
    std::vector<ToleranceCard*> cards_;  // in the order of all_
    int shown_ = -1;
    bool dirty_ = false;
    bool follow_ = true;  // the plot follows the run until the operator chooses a card
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
