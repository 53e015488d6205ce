// ViewPanel.h - settings of the view: time base and position, how many captures stay on the screen or are averaged,
// calculated curves, and the spectrum.
#pragma once

#include <QWidget>

#include "app/gui/scope/model/Trace.h"

class QCheckBox;
class QComboBox;
class QSettings;

namespace tacto::gui {

class QuantitySpin;
class ScopeModel;

class ViewPanel final : public QWidget {
    Q_OBJECT
public:
    /// `model` outlives this.
    ViewPanel(ScopeModel& model, QWidget* parent);
    [[nodiscard]] MathOptions mathOptions() const;
    [[nodiscard]] bool wantsSpectrum() const;
    void setSpectrum(bool on);
    /// Number of captures that are averaged; 1: no averaging.
    [[nodiscard]] int average() const;
    void setAverage(int captures);
    /// The number of captures that the user last chose to average.
    [[nodiscard]] int lastAverage() const noexcept { return lastAverage_; }

    void save(QSettings& settings) const;
    /// Skips values that are missing or not possible.
    void restore(const QSettings& settings);

signals:
    void mathOptionsChanged();
    void spectrumToggled(bool on);
    void averageChanged(int captures);

private:
    void follow();
    void offerDifferences();

    ScopeModel& model_;
    QComboBox* base_;
    QuantitySpin* centre_;
    QComboBox* persistence_;
    QComboBox* average_;
    QCheckBox* power_;
    QCheckBox* charge_;
    QComboBox* difference_;
    QCheckBox* spectrum_;
    int lastAverage_ = 16;
    QStringList wantedDifference_;  ///< saved choice, used once its lanes exist
};

}  // namespace tacto::gui
