#include "app/gui/scope/panels/StepBox.h"

#include <QComboBox>
#include <QSignalBlocker>
#include <cmath>

#include "app/gui/scope/model/Steps.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr double kSame = 1e-6;  // relative

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

}  // namespace tacto::gui
