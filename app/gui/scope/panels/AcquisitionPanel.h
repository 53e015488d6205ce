// AcquisitionPanel.h - settings of the next capture: trigger, length, sample rate and ranges.
//
// The fields of each kind of trigger come from core/measure/SampleTrigger.h. In Auto the level of the oscilloscope's
// own trigger follows the commanded amplitude; the panel shows the level, and the user cannot set it.
#pragma once

#include <QWidget>
#include <optional>

#include "core/devices/Oscilloscope.h"
#include "core/measure/SampleTrigger.h"

class QComboBox;
class QFormLayout;
class QLabel;
class QSettings;
class QSpinBox;

namespace tacto::gui {

class FieldForm;
class QuantitySpin;

class AcquisitionPanel final : public QWidget {
    Q_OBJECT
public:
    explicit AcquisitionPanel(QWidget* parent = nullptr);

    /// Takes over what the open oscilloscope can do; without an oscilloscope the last traits stay.
    void setTraits(const ScopeTraits& traits);
    /// The settings chosen here, limited to what the oscilloscope can do.
    [[nodiscard]] ScopeSettings settings() const;
    /// The trigger chosen here, as it was when all its fields were last valid.
    [[nodiscard]] const SampleTrigger& trigger() const { return trigger_; }
    [[nodiscard]] bool triggersOnCurrent() const;
    /// Sets the level in V or A.
    void setLevel(double level);
    /// Sets the other threshold of a runt, as if it were typed.
    void setUpper(double level);
    void setPreTrigger(double fraction);
    /// True: the user cannot set the level now.
    void setLevelHeld(bool held);

    void save(QSettings& settings) const;
    /// Skips values that are missing or not possible. Does not send changed().
    void restore(const QSettings& settings);

signals:
    void changed();
    /// Asks for the next (1) or the previous (-1) place in the shown record that matches the trigger.
    void matchWanted(int step);

private:
    [[nodiscard]] QWidget* buildFind();
    QComboBox* combo(const QString& name, const QString& tip);
    void fillRates();
    void sourceChanged();
    /// Shows the fields of the present kind of trigger.
    void showTrigger();
    void showUsed(const SampleTrigger& its);
    /// Takes over the fields. Returns false if nothing changed, or if one is not valid: it then says why.
    bool takeTrigger();
    [[nodiscard]] const char* unit() const;  ///< of the level
    [[nodiscard]] double fullScale() const;
    [[nodiscard]] const char* unitOf(const TriggerField& field) const;
    /// Factor from the unit of a field's value to the unit in which it is typed.
    [[nodiscard]] double scaleOf(const TriggerField& field) const;
    [[nodiscard]] std::size_t depth() const;
    void say();
    [[nodiscard]] double rate_hz() const;

    ScopeTraits traits_;
    double wantedRate_hz_ = 0;  ///< the rate the user chose, even if the open oscilloscope lacks it; 0: automatic
    SampleTrigger trigger_{.level = 1, .upper = 2};
    QComboBox* kind_;
    QComboBox* source_;
    QuantitySpin* level_;
    FieldForm* fields_;
    QWidget* find_;
    QFormLayout* form_ = nullptr;
    QSpinBox* preTrigger_;
    QComboBox* length_;
    QComboBox* rate_;
    QComboBox* volts_;
    QComboBox* amps_;
    QLabel* said_;
};

}  // namespace tacto::gui
