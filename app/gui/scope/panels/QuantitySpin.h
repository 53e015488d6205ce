// QuantitySpin.h - a number with its unit, as people write it: "2 V", "15 mA", "-1.5 ms".
//
// The value is in the unit given (V, A, s); any prefix may be typed. Four significant digits are shown; the value keeps
// what it has. Steps follow the size of the number.
#pragma once

#include <optional>

#include "app/gui/theme/TypedSpin.h"

class QComboBox;
class QString;

namespace tacto::gui {

/// "1.5 ms" in s is 0.0015; a number alone is in `unit`. Nothing when it is not a quantity of that unit.
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

/// Into a box of scales: "20 V/div", with its value as data.
void addStep(QComboBox& box, double perDivision, const QString& unit);
/// Chooses the present scale. One that is not a step of the ladder stands last, as long as it is the present one.
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
