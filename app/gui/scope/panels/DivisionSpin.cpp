#include "app/gui/scope/panels/DivisionSpin.h"

#include "app/gui/theme/Text.h"

namespace tacto::gui {

namespace {

constexpr QChar kMinus(0x2212);

/// As Qt reads it.
QString hyphened(QString text) { return text.replace(kMinus, '-'); }

}  // namespace

DivisionSpin::DivisionSpin(QWidget* parent) : QDoubleSpinBox(parent) {
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
    const auto state = QDoubleSpinBox::validate(plain, at);
    text = plain.replace('-', kMinus);
    return state;
}

}  // namespace tacto::gui

#include "moc_DivisionSpin.cpp"
