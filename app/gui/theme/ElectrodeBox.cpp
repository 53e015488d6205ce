#include "app/gui/theme/ElectrodeBox.h"

#include <QSettings>
#include <QSignalBlocker>
#include <cmath>

#include "app/gui/theme/Building.h"
#include "core/base/TypedNumber.h"

namespace tacto::gui {

namespace {

constexpr const char* kAreas = "electrodeAreas";
constexpr const char* kLast = "electrode";
constexpr int kNameLimit = 60, kShownChars = 9;

QVariantMap areas() { return QSettings().value(kAreas).toMap(); }

bool isArea(const QString& text) {
    const auto area = typedNumber(text.trimmed().toStdString());
    return area && std::isfinite(*area) && *area > 0;
}

bool sameArea(const QString& one, const QString& other) {
    return isArea(one) && typedNumber(one.trimmed().toStdString()) == typedNumber(other.trimmed().toStdString());
}

}  // namespace

ElectrodeBox::ElectrodeBox(QLineEdit& area, QWidget* parent) : QComboBox(parent), area_(area) {
    nameWidget(*this, "electrode", tr("Electrode"),
               tr("Name the electrode, then type its area: choosing the name brings it back. To change it, empty the "
                  "area, press Enter, and type the new one."));
    setEditable(true);
    setInsertPolicy(NoInsert);
    setCompleter(nullptr);  // the name of another electrode is never put in its place
    setSizeAdjustPolicy(AdjustToMinimumContentsLengthWithIcon);
    setMinimumContentsLength(kShownChars);
    lineEdit()->setMaxLength(kNameLimit);
    lineEdit()->setPlaceholderText(tr("electrode"));
    list();
    follow();
    connect(this, &QComboBox::activated, this, &ElectrodeBox::name);
    connect(lineEdit(), &QLineEdit::editingFinished, this, &ElectrodeBox::name);
    connect(&area_, &QLineEdit::returnPressed, this, &ElectrodeBox::confirm);  // before editingFinished
    connect(&area_, &QLineEdit::editingFinished, this, &ElectrodeBox::keep);
    connect(&area_, &QLineEdit::textChanged, this, [this] {
        if (!area_.isModified()) follow();
    });
}

std::optional<QString> ElectrodeBox::named() const {
    return area_.text().trimmed().isEmpty() ? std::nullopt : std::optional(currentText().trimmed());
}

void ElectrodeBox::showPopup() {
    list();
    QComboBox::showPopup();
}

void ElectrodeBox::list() {
    const QSignalBlocker quiet(this);
    const auto shown = currentText();
    clear();
    addItems(areas().keys());
    setCurrentIndex(findText(shown, Qt::MatchFixedString | Qt::MatchCaseSensitive));
    setEditText(shown);
}

/// The electrode was chosen or named. The area that stands beside a new name was not typed for it.
void ElectrodeBox::name() {
    const auto name = currentText().trimmed();
    if (name.isEmpty()) return;
    area_.setModified(false);
    const auto known = areas().value(name).toString();
    if (known.isEmpty()) return;
    QSettings().setValue(kLast, name);
    if (area_.text().trimmed() != known) area_.setText(known);
}

/// Enter in the area says that it is this electrode's; in an empty one, that the electrode's is to be forgotten.
void ElectrodeBox::confirm() {
    if (!area_.text().trimmed().isEmpty()) return area_.setModified(true);
    auto all = areas();
    if (all.remove(currentText().trimmed()) > 0) QSettings().setValue(kAreas, all);
}

/// Keeps an area that was typed while an electrode without one was named. Another area than the named electrode's
/// belongs to none.
void ElectrodeBox::keep() {
    const auto name = currentText().trimmed(), area = area_.text().trimmed();
    if (name.isEmpty() || !area_.isModified()) return;
    auto all = areas();
    const auto known = all.value(name).toString();
    if (!known.isEmpty() && !sameArea(known, area)) return clearEditText();
    if (!isArea(area)) return;
    QSettings().setValue(kLast, name);
    if (!known.isEmpty()) return;
    all[name] = area;
    QSettings().setValue(kAreas, all);
}

/// An area that the program filled in belongs to the electrode named last, or to none.
void ElectrodeBox::follow() {
    const auto last = QSettings().value(kLast).toString();
    setEditText(sameArea(areas().value(last).toString(), area_.text()) ? last : QString());
}

}  // namespace tacto::gui

#include "moc_ElectrodeBox.cpp"
