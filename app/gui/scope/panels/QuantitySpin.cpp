#include "app/gui/scope/panels/QuantitySpin.h"

#include <QStyle>
#include <QStyleOptionSpinBox>
#include <cmath>

#include "app/gui/scope/model/Steps.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr int kDecimals = 12;  // digits of the value that is held
constexpr int kDigits = 4;     // significant digits of it that are shown

/// No user sets a level to a millionth, or reads one.
double asShown(double value) { return QString::number(value, 'g', kDigits).toDouble(); }

}  // namespace

std::optional<double> parseQuantity(const QString& text, const QString& unit) {
    QString plain = text;
    plain.remove(QChar(0x202f)).remove(' ');
    plain.replace(QChar(0x2212), '-').replace(QChar(0x03bc), QChar(0x00b5)).replace(',', '.');
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
    bool isNumber = false;
    const double number = plain.toDouble(&isNumber);
    if (!isNumber || !std::isfinite(number)) return std::nullopt;
    return number * factor;
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
    // The digits that are not shown stay until the user types others.
    if (text == textFromValue(value())) return value();
    return parseQuantity(text, unit_).value_or(value());
}

QValidator::State QuantitySpin::validate(QString& text, int&) const {
    const auto parsed = parseQuantity(text, unit_);
    return parsed && *parsed >= minimum() && *parsed <= maximum() ? QValidator::Acceptable : QValidator::Intermediate;
}

void QuantitySpin::stepBy(int steps) {
    // A tenth of the number's own size, a round one.
    const double size = std::abs(value()) > 1e-9 ? std::abs(value()) : maximum() / 100;
    const double step = stepNotBelow(size / 20);
    setValue(std::round(value() / step + steps) * step);
    selectAll();
}

QSize QuantitySpin::sizeHint() const {
    auto hint = QDoubleSpinBox::sizeHint();
    QStyleOptionSpinBox option;
    initStyleOption(&option);
    const QSize text(fontMetrics().horizontalAdvance("−000.00 mm") + 6, fontMetrics().height());
    hint.setWidth(style()->sizeFromContents(QStyle::CT_SpinBox, &option, text, this).width());
    return hint;
}

}  // namespace tacto::gui

#include "moc_QuantitySpin.cpp"
