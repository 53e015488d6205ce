// DivisionSpin.h - a position in divisions of the screen, "−1.50 div"; typed with a hyphen or a minus sign.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QDoubleSpinBox>

namespace tacto::gui {

class DivisionSpin final : public QDoubleSpinBox {
    Q_OBJECT
public:
    explicit DivisionSpin(QWidget* parent = nullptr);

    QString textFromValue(double value) const override;
    double valueFromText(const QString& text) const override;
    QValidator::State validate(QString& text, int& at) const override;
};

}  // namespace tacto::gui
