// QuantitySpin.h - an input field for a number with its unit, as people write them: "2 V", "15 mA", "-1.5 ms".
//
// The value is in the unit given (V, A, s); the user can type any prefix. Four significant digits are shown, but the
// value keeps all its digits. Steps grow with the number.
#pragma once

#include <optional>

#include "app/gui/theme/TypedSpin.h"

class QComboBox;
class QString;

namespace tacto::gui {

/// Returns 0.0015 for "1.5 ms" in s; a number without a unit is in `unit`. Nothing if the text is not in that unit.
[[nodiscard]] std::optional<double> parseQuantity(const QString& text, const QString& unit);

class QuantitySpin final : public QDoubleSpinBox {
    Q_OBJECT
public:
    QuantitySpin(const QString& unit, double low, double high, QWidget* parent = nullptr);
    void setUnit(const QString& unit, double low, double high);
    [[nodiscard]] QString unit() const { return unit_; }

    QString textFromValue(double value) const override;
    double valueFromText(const QString& text) const override;
    QValidator::State validate(QString& text, int& at) const override;
    void stepBy(int steps) override;

private:
    QString unit_;
};

/// Adds a scale such as "20 V/div" to a box, with its value as data.
void addStep(QComboBox& box, double perDivision, const QString& unit);
/// Selects the present scale. If it is not a step of the ladder, the box lists it last until another scale is chosen.
void showStep(QComboBox& box, double now, const QString& unit);

/// A position in divisions of the screen, "−1.50 div"; typed with a hyphen or a minus sign.
class DivisionSpin final : public TypedSpin {
    Q_OBJECT
public:
    explicit DivisionSpin(QWidget* parent = nullptr);

    QString textFromValue(double value) const override;
    double valueFromText(const QString& text) const override;
    QValidator::State validate(QString& text, int& at) const override;
};

}  // namespace tacto::gui
