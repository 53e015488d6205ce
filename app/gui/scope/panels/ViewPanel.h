// ViewPanel.h - time base and position, how many captures stay on the screen or are averaged, what is calculated, the
// spectrum.
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
    /// Captures that are averaged; 1: none.
    [[nodiscard]] int average() const;
    void setAverage(int captures);
    /// The number that was chosen last.
    [[nodiscard]] int lastAverage() const noexcept { return lastAverage_; }

    void save(QSettings& settings) const;
    /// Values that are missing or not possible stay as they are.
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
    QStringList wantedDifference_;  ///< remembered, until there are lanes to take it of
};

}  // namespace tacto::gui
