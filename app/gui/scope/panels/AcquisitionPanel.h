// AcquisitionPanel.h - what the next capture is to be: on what it triggers, how long it is, how fine, in which ranges.
//
// In Auto the level follows the commanded amplitude and is shown, not set.
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

    /// Settings of the oscilloscope that is open; without one the last stay.
    void setTraits(const ScopeTraits& traits);
    /// The settings chosen here, within what the oscilloscope can do.
    [[nodiscard]] ScopeSettings settings() const;
    [[nodiscard]] bool triggersOnCurrent() const;
    /// V or A.
    void setLevel(double level);
    void setPreTrigger(double fraction);
    /// The level is not the user's now.
    void setLevelHeld(bool held);

    void save(QSettings& settings) const;
    /// Values that are missing or not possible stay as they are. Does not send changed().
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
    double wantedRate_hz_ = 0;  ///< chosen, though the oscilloscope that is open may not offer it; 0: automatic
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
