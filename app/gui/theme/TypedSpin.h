// TypedSpin.h - a number with arrows, typed with a decimal point or a decimal comma: the comma becomes a point as it is
// typed. Qt's own box drops the comma, and "0,5" is 5.
#pragma once

#include <QDoubleSpinBox>

namespace tacto::gui {

class TypedSpin : public QDoubleSpinBox {
public:
    using QDoubleSpinBox::QDoubleSpinBox;

    QValidator::State validate(QString& text, int& at) const override {
        if (decimals() > 0) text.replace(',', '.');
        return QDoubleSpinBox::validate(text, at);
    }
};

}  // namespace tacto::gui
