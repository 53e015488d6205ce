#include "app/gui/scope/panels/QuantitySpin.h"

#include <QComboBox>
#include <QSignalBlocker>
#include <cmath>

#include "app/gui/scope/model/Viewport.h"
#include "app/gui/theme/Text.h"
#include "app/report/NumberText.h"
#include "core/base/TypedNumber.h"

namespace tacto::gui {

namespace {

constexpr int kDecimals = 12;  // decimals of the stored value
constexpr int kDigits = 4;     // significant digits that are shown

/// Rounds a value to the digits that are shown.
double asShown(double value) { return QString::number(value, 'g', kDigits).toDouble(); }

}  // namespace

std::optional<double> parseQuantity(const QString& text, const QString& unit) {
    QString plain = text;
    plain.remove(QChar(0x202f)).remove(' ');
    plain.replace(QChar(0x2212), '-').replace(QChar(0x03bc), QChar(0x00b5));
    double factor = 1;
    if (!unit.isEmpty() && plain.endsWith(unit)) plain.chop(unit.size());
    static const QString prefixes = QString::fromUtf8("pnuµmkMG");
    static constexpr std::array<double, 8> factors{1e-12, 1e-9, 1e-6, 1e-6, 1e-3, 1e3, 1e6, 1e9};
    if (!plain.isEmpty()) {
        if (const auto index = prefixes.indexOf(plain.back()); index >= 0) {
            factor = factors[static_cast<std::size_t>(index)];
            plain.chop(1);
        }
    }
    const auto number = typedNumber(plain.toStdString());
    if (!number || !std::isfinite(*number)) return std::nullopt;
    return *number * factor;
}

QuantitySpin::QuantitySpin(const QString& unit, double low, double high, QWidget* parent) : QDoubleSpinBox(parent) {
    setDecimals(kDecimals);
    setKeyboardTracking(false);
    setAlignment(Qt::AlignRight);
    setUnit(unit, low, high);
}

void QuantitySpin::setUnit(const QString& unit, double low, double high) {
    unit_ = unit;
    setRange(low, high);
}

QString QuantitySpin::textFromValue(double value) const {
    return settingText(std::abs(value) < 1e-11 ? 0 : asShown(value), unit_);
}

double QuantitySpin::valueFromText(const QString& text) const {
    // The digits that are not shown stay until the user types another number.
    if (text == textFromValue(value())) return value();
    return parseQuantity(text, unit_).value_or(value());
}

QValidator::State QuantitySpin::validate(QString& text, int&) const {
    const auto parsed = parseQuantity(text, unit_);
    return parsed && *parsed >= minimum() && *parsed <= maximum() ? QValidator::Acceptable : QValidator::Intermediate;
}

void QuantitySpin::stepBy(int steps) {
    // A round step of about a tenth of the number.
    const double size = std::abs(value()) > 1e-9 ? std::abs(value()) : maximum() / 100;
    const double step = stepNotBelow(size / 20);
    setValue(std::round(value() / step + steps) * step);
    selectAll();
}

namespace {

constexpr double kSame = 1e-6;  // relative difference up to which two values are equal

bool onLadder(double value) { return std::abs(stepNotBelow(value * (1 - kSame)) - value) <= kSame * value; }

}  // namespace

void addStep(QComboBox& box, double perDivision, const QString& unit) {
    const auto exact = settingText(perDivision, unit), rounded = quantityText(perDivision, unit, 3);
    box.addItem(QObject::tr("%1/div").arg(exact.size() <= rounded.size() ? exact : rounded), perDivision);
}

void showStep(QComboBox& box, double now, const QString& unit) {
    const QSignalBlocker quiet(&box);
    const auto last = box.count() - 1;
    if (last >= 0 && !onLadder(box.itemData(last).toDouble())) box.removeItem(last);
    for (int i = 0; i < box.count(); ++i) {
        if (std::abs(box.itemData(i).toDouble() - now) <= kSame * now) return box.setCurrentIndex(i);
    }
    addStep(box, now, unit);
    box.setCurrentIndex(box.count() - 1);
}

namespace {

constexpr QChar kMinus(0x2212);

/// The text with a hyphen as the minus sign, which Qt can read.
QString hyphened(QString text) { return text.replace(kMinus, '-'); }

}  // namespace

DivisionSpin::DivisionSpin(QWidget* parent) : TypedSpin(parent) {
    setLocale(QLocale::c());  // numbers are written alike everywhere
    setRange(-1000, 1000);
    setDecimals(2);
    setSingleStep(0.5);
    setSuffix(tr(" div"));
    setKeyboardTracking(false);
    setAlignment(Qt::AlignRight);
}

QString DivisionSpin::textFromValue(double value) const { return decimalText(value, decimals()); }

double DivisionSpin::valueFromText(const QString& text) const { return QDoubleSpinBox::valueFromText(hyphened(text)); }

QValidator::State DivisionSpin::validate(QString& text, int& at) const {
    auto plain = hyphened(text);
    const auto state = TypedSpin::validate(plain, at);
    text = plain.replace('-', kMinus);
    return state;
}

}  // namespace tacto::gui

#include "moc_QuantitySpin.cpp"
