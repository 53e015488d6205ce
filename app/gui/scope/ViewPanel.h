// ViewPanel.h - time base and position, how many captures stay on the screen, what is calculated, the spectrum.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QWidget>

#include "app/gui/scope/Trace.h"

class QCheckBox;
class QComboBox;
class QSettings;

namespace tacto::gui {

class QuantitySpin;
class ScopeView;

class ViewPanel final : public QWidget {
    Q_OBJECT
public:
    /// `view` outlives this.
    ViewPanel(ScopeView& view, QWidget* parent);
    [[nodiscard]] MathOptions wish() const;
    [[nodiscard]] bool wantsSpectrum() const;

    void save(QSettings& settings) const;
    /// What is not there or not possible stays as it is.
    void restore(const QSettings& settings);

signals:
    void wishChanged();
    void spectrumToggled(bool on);

private:
    void follow();
    void offerDifferences();

    ScopeView& view_;
    QComboBox* base_;
    QuantitySpin* centre_;
    QComboBox* persistence_;
    QCheckBox* power_;
    QCheckBox* charge_;
    QComboBox* difference_;
    QCheckBox* spectrum_;
    QStringList wantedDifference_;  ///< remembered, until there are lanes to take it of
};

}  // namespace tacto::gui
