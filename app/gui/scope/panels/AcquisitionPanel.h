// AcquisitionPanel.h - settings of the next capture: trigger, length, sample rate and ranges.
//
// In Auto the level follows the commanded amplitude; the panel shows the level, and the user cannot set it.
#pragma once

#include <QWidget>
#include <optional>

#include "core/devices/Oscilloscope.h"

class QComboBox;
class QLabel;
class QSettings;
class QSpinBox;

namespace tacto::gui {

class QuantitySpin;

class AcquisitionPanel final : public QWidget {
    Q_OBJECT
public:
    explicit AcquisitionPanel(QWidget* parent = nullptr);

    /// Takes over what the open oscilloscope can do; without an oscilloscope the last traits stay.
    void setTraits(const ScopeTraits& traits);
    /// The settings chosen here, limited to what the oscilloscope can do.
    [[nodiscard]] ScopeSettings settings() const;
    [[nodiscard]] bool triggersOnCurrent() const;
    /// Sets the level in V or A.
    void setLevel(double level);
    void setPreTrigger(double fraction);
    /// True: the user cannot set the level now.
    void setLevelHeld(bool held);

    void save(QSettings& settings) const;
    /// Skips values that are missing or not possible. Does not send changed().
    void restore(const QSettings& settings);

signals:
    void changed();

private:
    QComboBox* combo(const QString& name, const QString& tip);
    void fillRates();
    void sourceChanged();
    void say();
    [[nodiscard]] double rate_hz() const;

    ScopeTraits traits_;
    double wantedRate_hz_ = 0;  ///< the rate the user chose, even if the open oscilloscope lacks it; 0: automatic
    QComboBox* source_;
    QuantitySpin* level_;
    QSpinBox* preTrigger_;
    QComboBox* length_;
    QComboBox* rate_;
    QComboBox* volts_;
    QComboBox* amps_;
    QLabel* said_;
};

}  // namespace tacto::gui
